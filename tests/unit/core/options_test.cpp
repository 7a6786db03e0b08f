#include "libfsi/core/options.hpp"

#include <gtest/gtest.h>
#include <petscsys.h>

#include "libfsi/core/error.hpp"

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
    EXPECT_EQ(error.kind(), Kind::input);
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
}

TEST(Options, AnUnknownNameIsAnErrorWithTheNearestOne) {
  const auto read = [](Options& o) { viscosity(o), o.check_unknown(); };
  EXPECT_NE(sentence("-fluid_viscocity 1", read).find("nearest is -fluid_viscosity"),
            std::string::npos);
  EXPECT_EQ(sentence("-fluid_viscosity 1 -p_ksp_monitor", read), "");
}

TEST(Options, AnOptionNobodyReadIsAnError) {
  const auto read = [](Options& o) { o.check_unused(); };
  EXPECT_NE(sentence("-p_ksp_typo 1", read).find("-p_ksp_typo"), std::string::npos);
}

}  // namespace
}  // namespace fsi
