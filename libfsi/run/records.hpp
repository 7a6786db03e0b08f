#pragma once
// The rows of flow.csv and solid.csv.

#include <string>
#include <vector>

#include "libfsi/analysis/motion.hpp"
#include "libfsi/analysis/orientation.hpp"
#include "libfsi/core/clock.hpp"
#include "libfsi/io/checkpoint.hpp"
#include "libfsi/run/case.hpp"
#include "libfsi/run/samples.hpp"

namespace fsi {

/// The names of the columns.
std::vector<std::string> names(const std::vector<Entry>& row);
/// The numbers.
std::vector<Real> values(const std::vector<Entry>& row);

/// Collective. [patches] D = (4 A / pi)^(1/2), in 2-D the width, of each patch with its images in
/// the planes of symmetry that meet it.
std::vector<Real> whole_diameters(const Solver& solver);

/// Collective. A row of flow.csv, for the flow after a step of length dt. diameters: of
/// `whole_diameters`; elastic_energy: of all solids.
/// - pressure_drop: between the patches inlet and outlet, S times the period in a periodic channel.
/// - pressure_span: max p - min p of the cells without solid.
/// - dissipation: that of `dissipation`.
/// - flow_rate: through the patch `outlet`, or the section of a periodic channel.
/// - us and dt: as they are.
/// - limit: what set dt. 0 nothing, 1 -time_step, 2 advective, 3 elastic, 4 start,
/// 5 -time_step_max, 6 an event to be met (a file or the end), 7 growth after a rejected step,
/// 8 strain of the solid.
/// - flow_rate_NAME: out of the domain through each patch NAME that fluid goes through.
/// - mean_pressure_NAME: of the same patches. At an opening it is the given pressure with the part
/// of its load, in the middle of the step. If the flow is prescribed, it is that of the cells at
/// the patch.
/// - reynolds: rho U D / mu_f with the mean velocity and D of the patch where it is largest.
std::vector<Entry> flow_row(Solver& solver, const std::vector<Real>& diameters, Real elastic_energy,
                            const Limit& limit, Real dt, Real wall_per_step);

/// Collective. The integral of 2 mu D : D. A more viscous solid has the D of its own side in cells
/// at its surface, by the last step; D of all else is that of the cell.
Real dissipation(Solver& solver);

/// Figures by which the result of a solid is judged.
struct Soundness {
  Real eigenvalue_min = 1;                ///< of B in cells more than half solid
  int pieces = 1;                         ///< of a hundredth of its volume or more
  Real elastic_energy = 0;                ///< that of the stress
  Real shape_energy = 0;                  ///< that of the strain that the map gives
  Real map_det_min = 1, map_det_max = 1;  ///< of the map, in cells at least half solid
  Real bond_kept = 1;                     ///< part of the faces of its bond that it still covers
};

/// Makes the rows of a solid. Its data from earlier rows are part of a checkpoint.
class SolidRecord {
 public:
  /// ring: whether the shape is a torus, whose deformation is measured too.
  explicit SolidRecord(bool ring) : ring_(ring) {}

  /// Collective. A row of solid.csv, of one body of the solver: centroid, velocity and `taylor` at
  /// the state's time, the shape at that of the solid.
  std::vector<Entry> row(const Solver& solver, const Body& body);
  /// Relative change of volume since the start, at the last row.
  Real drift() const { return drift_; }
  /// At the last row.
  const Soundness& soundness() const { return soundness_; }
  /// name: of the body.
  void list(io::Snapshot& snapshot, const std::string& name);

 private:
  bool ring_;
  analysis::Tracker tracker_;
  std::int64_t started_ = 0;  // of the tracker, as a checkpoint holds it
  analysis::Orientation orientation_;
  Vec3 zeta_;
  std::int64_t rod_ = -1;  ///< 1: its axis of revolution is the longest; -1: not known yet
  Real turned_ = 0;        // degrees about z
  Real volume_0_ = 0, drift_ = 0;
  Soundness soundness_;
};

/// The largest drift of the volume, of all solids.
Real largest_drift(const std::vector<SolidRecord>& records);

/// Collective. Area (length in 2-D) of a solid's surface in the fluid: that of the planes in its
/// cells. An isosurface of alpha would round a small body.
Real surface_area(const Body& body);

/// Collective. Elastic energy of the strain that the map gives, of the memory or of the map
/// kinematics; 0 without one. A cell whose extrapolated map has no trust takes the mean strain of
/// its mapped neighbours.
Real shape_energy(const Body& body);

}  // namespace fsi
