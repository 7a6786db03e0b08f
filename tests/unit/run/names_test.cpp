// Names of patches and solids of which one begins with the other: an option acts on one of them.

#include <gtest/gtest.h>
#include <petscsys.h>

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "libfsi/core/error.hpp"
#include "libfsi/run/case.hpp"
#include "libfsi/run/patches.hpp"
#include "tests/unit/support/box_mesh.hpp"

namespace fsi {
namespace {

/// What is said of the options, "" where nothing is; and those that a run writes down.
struct Outcome {
  std::string sentence, recorded;
};

Outcome outcome(const std::string& given, const std::function<void(Options&)>& read) {
  FSI_PETSC(PetscOptionsClear(nullptr));
  FSI_PETSC(PetscOptionsInsertString(nullptr, given.c_str()));
  Options options("test", "a test");
  Outcome found;
  try {
    read(options);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input) << error.what();
    found.sentence = error.what();
  }
  for (const auto& [name, value] : options.values())
    found.recorded.append(" -").append(name).append(" ").append(value);
  FSI_PETSC(PetscOptionsClear(nullptr));
  return found;
}

/// In a channel between `wall` and `symmetry` whose other sides have these names.
Outcome of_patches(const std::string& one, const std::string& other, const std::string& given,
                   Conditions* conditions = nullptr) {
  Mesh mesh = test::box_mesh({.n = {4, 4, 0}});
  mesh.patches[0].name = one, mesh.patches[1].name = other;
  mesh.patches[2].name = "wall", mesh.patches[3].name = "symmetry";
  return outcome(given, [&](Options& options) {
    const Conditions read = read_patches(options, mesh);
    options.check_unknown();
    if (conditions != nullptr) *conditions = read;
  });
}

Outcome of_solids(const std::string& given, std::vector<SolidSetup>* solids = nullptr) {
  return outcome(given, [&](Options& options) {
    const std::vector<SolidSetup> read = read_solids(options, {});
    if (solids != nullptr) *solids = read;
  });
}

bool names(const std::string& sentence, const std::string& option, const std::string& one,
           const std::string& other) {
  const auto has = [&](const std::string& text) {
    return sentence.find(text) != std::string::npos;
  };
  return has("option -" + option + " ") && has("\"" + one + "\"") && has("\"" + other + "\"") &&
         has("rename one of them");
}

TEST(Names, AnOptionOfTwoPatchesIsRefused) {
  const std::string aorta =
      "-patches_aorta_type windkessel -patches_aorta_resistance 1 -patches_aorta_capacitance 0.1 ";
  const std::string far = "-patches_aorta_distal_resistance 10 ";
  EXPECT_TRUE(names(of_patches("aorta", "aorta_stored",
                               aorta + far +
                                   "-patches_aorta_stored_type pressure "
                                   "-patches_aorta_stored_pressure 3")
                        .sentence,
                    "patches_aorta_stored_pressure", "aorta", "aorta_stored"));
  // The order of the patches does not matter, nor do capitals.
  EXPECT_TRUE(names(of_patches("Aorta_Distal", "aorta",
                               aorta + "-patches_aorta_distal_type resistance "
                                       "-patches_aorta_distal_resistance 3")
                        .sentence,
                    "patches_aorta_distal_resistance", "aorta", "Aorta_Distal"));
  const std::string wall = "-patches_lid_type wall -patches_lid_wall_velocity 1,0,0 ";
  for (const char* type : {"velocity", "pressure", "wall"})  // whatever the type of the other one
    EXPECT_TRUE(
        names(of_patches("lid", "lid_wall", wall + "-patches_lid_wall_type " + type).sentence,
              "patches_lid_wall_velocity", "lid", "lid_wall"))
        << type;
}

TEST(Names, AnOptionThatOnePatchTakesIsThatOfThePatch) {
  Conditions read;
  EXPECT_EQ(of_patches("inlet", "inlet_wall",
                       "-patches_inlet_type flow_rate -patches_inlet_flow_rate 2 "
                       "-patches_inlet_wall_type velocity -patches_inlet_wall_velocity 1,0,0",
                       &read)
                .sentence,
            "");
  EXPECT_EQ(std::get<FixedVelocity>(read["inlet_wall"]).u({}, 0), (Vec3{1, 0, 0}));
  EXPECT_EQ(of_patches("inlet", "inlet_2",
                       "-patches_inlet_type pressure -patches_inlet_pressure 2 "
                       "-patches_inlet_2_type pressure -patches_inlet_2_pressure 3",
                       &read)
                .sentence,
            "");
  EXPECT_EQ(std::get<Opening>(read["inlet"]).pressure(0), 2);
  EXPECT_EQ(std::get<Opening>(read["inlet_2"]).pressure(0), 3);
}

// A name may begin with another one and a key of that: -patches_inlet_flow_rate is of `inlet`.
TEST(Names, AKeyMayBeginAsTheNameOfAnotherPatch) {
  Conditions read;
  EXPECT_EQ(of_patches("inlet", "inlet_flow",
                       "-patches_inlet_type flow_rate -patches_inlet_flow_rate 2 "
                       "-patches_inlet_flow_type pressure -patches_inlet_flow_pressure 3",
                       &read)
                .sentence,
            "");
  EXPECT_EQ(std::get<FlowRate>(read["inlet"]).rate(0), 2);
  EXPECT_EQ(std::get<Opening>(read["inlet_flow"]).pressure(0), 3);
  EXPECT_EQ(of_patches("lid", "lid_velocity",
                       "-patches_lid_type velocity -patches_lid_velocity 1,0,0 "
                       "-patches_lid_velocity_type wall",
                       &read)
                .sentence,
            "");
  EXPECT_EQ(std::get<FixedVelocity>(read["lid"]).u({}, 0), (Vec3{1, 0, 0}));
  // What no patch takes is told of the one with the longest name.
  EXPECT_NE(of_patches("lid", "lid_velocity",
                       "-patches_lid_type wall -patches_lid_velocity_type wall "
                       "-patches_lid_velocity_colour 3")
                .sentence.find("a patch of type wall has no colour"),
            std::string::npos);
}

// The file that repeats a run gives every option, those too that nobody gave.
TEST(Names, PatchesThatShareADefaultRunAndRepeatTheirRun) {
  const std::vector<std::string> runs{
      "-patches_lid_type wall -patches_lid_wall_type wall",
      "-patches_lid_type wall -patches_lid_wall_type pressure -patches_lid_wall_pressure 3"};
  for (const std::string& given : runs) {
    const Outcome first = of_patches("lid", "lid_wall", given);
    EXPECT_EQ(first.sentence, "");
    EXPECT_NE(first.recorded.find("-patches_lid_wall_velocity 0,0,0"), std::string::npos);
    EXPECT_EQ(of_patches("lid", "lid_wall", first.recorded).sentence, "");
  }
}

// PETSc by itself gives an option of `inlet` to `inlet_2`, too.
TEST(Names, ANumberMakesAnotherName) {
  Conditions read;
  EXPECT_EQ(of_patches("inlet", "inlet_2",
                       "-patches_inlet_type pressure -patches_inlet_pressure 2 "
                       "-patches_inlet_2_type pressure",
                       &read)
                .sentence,
            "");
  EXPECT_EQ(std::get<Opening>(read["inlet_2"]).pressure(0), 0);
  EXPECT_NE(of_patches("inlet", "inlet_2", "-patches_inlet_type wall")
                .sentence.find("patch \"inlet_2\" of the mesh has no type"),
            std::string::npos);
  std::vector<SolidSetup> solids;
  of_solids("-solids_a_shape sphere -solids_a_radius 0.3 -solids_a_2_shape sphere", &solids);
  ASSERT_EQ(solids.size(), 2);
  EXPECT_EQ(solids[0].thickness, 0.6);
  EXPECT_EQ(solids[1].thickness, 0.4);
}

TEST(Names, AnOptionOfTwoSolidsIsRefused) {
  const std::string ring = "-solids_ring_shape torus ", option = "solids_ring_minor_radius";
  const auto refused = [&](const std::string& others) {
    return names(of_solids(ring + others).sentence, option, "ring", "ring_minor");
  };
  EXPECT_TRUE(refused("-solids_ring_minor_shape sphere -solids_ring_minor_radius 0.2"));
  EXPECT_TRUE(refused("-solids_ring_minor_shape sphere -solids_ring_minor_radius 0.7"));
  EXPECT_TRUE(refused("-solids_ring_minor_shape ellipsoid -solids_ring_minor_radius 0.2"));
  EXPECT_TRUE(refused("-solids_ring_minor_shape none -solids_ring_minor_radius 0.2"));
  // Without it as well: a torus and a sphere have different defaults, and a run writes one.
  EXPECT_TRUE(refused("-solids_ring_minor_shape sphere"));
  EXPECT_TRUE(names(of_solids("-solids_Ring_Major_shape disk -solids_ring_shape torus").sentence,
                    "solids_ring_major_radius", "ring", "Ring_Major"));
}

TEST(Names, SolidsWhoseOptionsDifferAreRead) {
  std::vector<SolidSetup> read;
  EXPECT_EQ(of_solids("-solids_ring_shape torus -solids_ring_2_shape sphere "
                      "-solids_ring_minor_radius 0.05 -solids_ring_2_radius 0.3",
                      &read)
                .sentence,
            "");
  ASSERT_EQ(read.size(), 2);
  EXPECT_EQ(read[0].thickness, 0.1);
  EXPECT_EQ(read[1].thickness, 0.6);
  const std::string small = "-solids_ring_minor_shape sphere -solids_ring_minor_radius 0.4 ";
  for (const char* shape : {"sphere", "none"}) {  // neither takes a minor radius
    const std::string given = small + "-solids_ring_shape " + shape;
    EXPECT_EQ(of_solids(given, &read).sentence, "") << shape;
    EXPECT_EQ(read.back().thickness, 0.8) << shape;
  }
  EXPECT_EQ(of_solids(small + "-solids_ring_shape torus -solid_shape none", &read).sentence, "");
  EXPECT_TRUE(read.empty());
  const Outcome law = of_solids(
      "-solids_ring_shape sphere -solids_ring_law gent -solids_ring_law_limit 9 "
      "-solids_ring_law_shape sphere");
  EXPECT_EQ(law.sentence, "");
}

}  // namespace
}  // namespace fsi
