#pragma once
// fsi-mesh: a report on a mesh before a run, and its other file format.

#include <string>
#include <vector>

#include "libfsi/core/run.hpp"
#include "libfsi/mesh/quality.hpp"
#include "libfsi/operators/face_weights.hpp"

namespace fsi {

/// The parameters of the scheme on a mesh, by owned cell. beta and theta are the largest of the
/// upwind shares beta and of the implicit shares theta_f of its internal faces
/// (operators/face_weights.hpp). rate is the Courant rate of a flow of speed 1 along the axis for
/// which it is largest, max_k sum_f |S_f . e_k| / (2 V).
struct Treatment {
  std::vector<Real> beta, theta, rate;          ///< [n_owned]
  Real beta_mean = 0, theta_mean = 0;           ///< over the internal faces of all ranks
  GlobalIndex n_internal = 0, n_irregular = 0;  ///< internal faces of all ranks
};

/// Collective.
Treatment treatment(const Mesh& mesh, const FaceWeights& weights);

/// A patch as a whole.
struct PatchFigures {
  GlobalIndex faces = 0;  ///< of all ranks
  Real area = 0;          ///< in 2-D the length
  Real diameter = 0;      ///< of the circle of that area, (4 A / pi)^(1/2); in 2-D the length
  Vec3 centre{};          ///< mean of its points
  Vec3 normal{};          ///< outward, of the sum of the area vectors; zero where they cancel
  Real degrees = 0;       ///< largest angle between a face's normal and that
  bool flat = false;      ///< all faces lie in one plane, to 1e-6 of the patch's size
};

/// Collective.
PatchFigures patch_figures(const Mesh& mesh, const Patch& patch);

/// Collective. Reads the mesh file and prints its report. Options: -mesh_periodic, -walls,
/// -symmetry, -worst, -worst_file. Errors: Error{input}.
RunStatus check_mesh_file(const std::string& file);

/// Collective. fsi-mesh convert: writes the gmsh file as one that all ranks read in parallel.
/// Option: -mesh_periodic. Errors: Error{input}, Error{io}.
RunStatus convert_mesh_file(const std::string& from, const std::string& to);

}  // namespace fsi
