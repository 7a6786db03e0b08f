#include "libfsi/core/options.hpp"

#include <gtest/gtest.h>
#include <petscsys.h>

#include <limits>

#include "libfsi/core/error.hpp"
#include "libfsi/core/version.hpp"

namespace fsi {
namespace {

/// The sentence of the error that `read` throws; empty when it throws none.
template <class F>
std::string sentence(const char* arguments, F read) {
  FSI_PETSC(PetscOptionsClear(nullptr));
  FSI_PETSC(PetscOptionsInsertString(nullptr, arguments));
  Options options("test", "a test");
  std::string text;
  try {
    read(options);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    text = error.what();
  }
  FSI_PETSC(PetscOptionsClear(nullptr));
  return text;
}

void viscosity(Options& options) {
  options.real("fluid_viscosity", 1, {.help = "mu", .unit = "", .positive = true});
}

TEST(Options, ReadsWhatIsGivenAndFallsBackOtherwise) {
  FSI_PETSC(PetscOptionsClear(nullptr));
  FSI_PETSC(PetscOptionsInsertString(nullptr, "-a 2.5 -n 3 -v 1,2,-3 -l in,out"));
  Options options("test", "a test");
  EXPECT_EQ(options.real("a", 1, {.help = ""}), 2.5);
  EXPECT_EQ(options.real("b", 7, {.help = ""}), 7);
  EXPECT_EQ(options.integer("n", 1, {.help = ""}), 3);
  EXPECT_EQ(options.vec3("v", {}, {.help = ""}), (Vec3{1, 2, -3}));
  EXPECT_EQ(options.list("l", ""), (std::vector<std::string>{"in", "out"}));
  EXPECT_NO_THROW(options.check_unknown());
  EXPECT_NE(options.yaml().find("a: \"2.5\""), std::string::npos);
  FSI_PETSC(PetscOptionsClear(nullptr));
}

// PETSc by itself gives -in_b to whoever asks for -in_2_b.
TEST(Options, ANameWithANumberInItIsAnotherName) {
  FSI_PETSC(PetscOptionsClear(nullptr));
  FSI_PETSC(PetscOptionsInsertString(nullptr, "-in_b 2.5 -In_3_B 4"));
  Options options("test", "a test");
  EXPECT_FALSE(options.given("in_2_b"));
  EXPECT_EQ(options.real("in_2_b", 7, {.help = ""}), 7);
  EXPECT_TRUE(options.given("in_3_b"));
  EXPECT_EQ(options.real("in_3_b", 7, {.help = ""}), 4);
  EXPECT_EQ(options.real("in_b", 7, {.help = ""}), 2.5);
  FSI_PETSC(PetscOptionsClear(nullptr));
}

TEST(Options, NoneIsAnEmptyListAsHelpHasIt) {
  const auto read = [](Options& options) {
    EXPECT_TRUE(options.list("l", "").empty());
    EXPECT_EQ(options.yaml().find("\nl:"), std::string::npos);
  };
  EXPECT_EQ(sentence("-l none", read), "");
  const auto with_others = [](Options& options) {
    EXPECT_EQ(options.list("l", ""), (std::vector<std::string>{"none", "in"}));
  };
  EXPECT_EQ(sentence("-l none,in", with_others), "");
}

TEST(Options, AFlagIsReadWhateverItsCapitals) {
  const auto read = [](Options& options) {
    EXPECT_TRUE(options.flag("a", false, ""));
    EXPECT_FALSE(options.flag("b", true, ""));
    EXPECT_TRUE(options.flag("c", false, ""));
  };
  EXPECT_EQ(sentence("-a True -b OFF -c", read), "");
  const auto wrong = [](Options& options) { options.flag("a", false, ""); };
  EXPECT_EQ(sentence("-a Ture", wrong),
            "option -a: \"Ture\" is not valid; choose from: true, false");
}

TEST(Options, AValueIsNotCutOff) {
  const auto read = [](Options& options) { options.text("a", "", ""); };
  const std::string text = sentence(("-a " + std::string(5000, 'x')).c_str(), read);
  EXPECT_EQ(text, "option -a has more than 4094 characters; give a shorter value");
}

TEST(Options, WithoutAFallbackMustBeGiven) {
  const auto read = [](Options& options) {
    const Real given = options.real("capacitance", std::numeric_limits<Real>::quiet_NaN(),
                                    {.help = "volume per pressure", .unit = ""});
    EXPECT_EQ(given, 3);
  };
  EXPECT_EQ(sentence("-capacitance 3", read), "");
  EXPECT_EQ(sentence("", read), "option -capacitance is missing: volume per pressure");
}

TEST(Options, NumbersOfAnEverydaySizeHaveNoExponent) {
  FSI_PETSC(PetscOptionsClear(nullptr));
  Options options("test", "a test");
  const std::vector<std::pair<Real, const char*>> numbers{{10, "10"},
                                                          {-360, "-360"},
                                                          {0.1, "0.1"},
                                                          {1e-4, "0.0001"},
                                                          {1e15, "1000000000000000"},
                                                          {1e6, "1000000"},
                                                          {0, "0"},
                                                          {-0.5, "-0.5"},
                                                          {1.0 / 3, "0.3333333333333333"},
                                                          {2e-5, "2e-05"},
                                                          {1e300, "1e+300"},
                                                          {123456.789, "123456.789"}};
  int number = 0;
  for (const auto& [value, text] : numbers) {
    const std::string name = std::string("a").append(std::to_string(number++));
    options.real(name, value, {.help = ""});
    EXPECT_EQ(options.values().at(name), text);
    EXPECT_EQ(std::stod(text), value);
  }
}

TEST(Options, TheFileThatRepeatsTheRunHasAnOptionOnceWhateverItsCapitals) {
  FSI_PETSC(PetscOptionsClear(nullptr));
  FSI_PETSC(PetscOptionsInsertString(nullptr, "-Fluid_Density 2 -P_ksp_rtol 1e-9"));
  Options options("test", "a test");
  EXPECT_EQ(options.real("fluid_density", 1, {.help = ""}), 2);
  const std::string yaml = options.yaml();
  EXPECT_NE(yaml.find("fluid_density: \"2\""), std::string::npos) << yaml;
  EXPECT_EQ(yaml.find("Fluid_Density"), std::string::npos) << yaml;
  EXPECT_NE(yaml.find("P_ksp_rtol: \"1e-9\""), std::string::npos) << yaml;
  FSI_PETSC(PetscOptionsClear(nullptr));
}

TEST(Options, TheFileThatRepeatsTheRunNamesVersionAndCommit) {
  const std::string yaml = Options("test", "a test").yaml();
  EXPECT_NE(yaml.find("\n# libfsi " + version() + ", commit " + commit() + "\n"),
            std::string::npos);
  EXPECT_FALSE(version().empty());
  EXPECT_FALSE(commit().empty());
}

TEST(Options, BadValuesNameTheOptionAndTheRange) {
  for (const char* value : {"nan", "inf", "-1", "0", "abc", "1.0x", "1e999"}) {
    const std::string text =
        sentence(("-fluid_viscosity " + std::string(value)).c_str(), viscosity);
    EXPECT_NE(text.find("-fluid_viscosity"), std::string::npos) << value;
    EXPECT_NE(text.find("value > 0"), std::string::npos) << value;
  }
  EXPECT_NE(sentence("-fluid_viscosity", viscosity), "");
}

TEST(Options, AWrongListLengthIsCounted) {
  const auto read = [](Options& o) { o.vec3("solid_center", {}, {.help = ""}); };
  EXPECT_NE(sentence("-solid_center 1,2", read).find("has 2 numbers"), std::string::npos);
  EXPECT_NE(sentence("-solid_center 1,2,3,4", read).find("has 4 numbers"), std::string::npos);
  EXPECT_NE(sentence("-solid_center 1,nan,3", read), "");
}

TEST(Options, AChoiceListsTheValidOnes) {
  const auto read = [](Options& o) { o.choice("solid_shape", "none", {"none", "torus"}, ""); };
  EXPECT_NE(sentence("-solid_shape tours", read).find("none, torus"), std::string::npos);
  EXPECT_NE(sentence("-solid_shape tours", read).find("nearest is torus"), std::string::npos);
  EXPECT_EQ(sentence("-solid_shape cube", read).find("nearest"), std::string::npos);
}

TEST(Options, AnUnknownNameIsAnErrorWithTheNearestOne) {
  const auto read = [](Options& o) { viscosity(o), o.check_unknown(); };
  EXPECT_NE(sentence("-fluid_viscocity 1", read).find("nearest is -fluid_viscosity"),
            std::string::npos);
  EXPECT_EQ(sentence("-fluid_viscosity 1 -p_ksp_monitor", read), "");
  EXPECT_NE(sentence("-soilds_left_shape torus", read).find("nearest is -solids_left_shape"),
            std::string::npos);
  EXPECT_NE(sentence("-fliud_viscosity 1", read).find("nearest is -fluid_viscosity"),
            std::string::npos);
}

TEST(Options, AnOptionNobodyReadIsAnError) {
  const auto read = [](Options& o) { o.check_unused(); };
  EXPECT_NE(sentence("-p_ksp_typo 1", read).find("-p_ksp_typo"), std::string::npos);
}

}  // namespace
}  // namespace fsi
