#pragma once
// An interface carried by a given velocity, and the files of such a run.

#include <algorithm>
#include <optional>
#include <string>

#include "libfsi/analysis/motion.hpp"
#include "libfsi/core/clock.hpp"
#include "libfsi/core/run.hpp"
#include "libfsi/io/fields.hpp"
#include "libfsi/io/file.hpp"
#include "libfsi/io/table.hpp"
#include "libfsi/run/case.hpp"
#include "libfsi/run/samples.hpp"
#include "libfsi/vof/motion.hpp"

namespace fsi {

/// The interface and its motion.
class PrescribedAdvection {
 public:
  /// Collective. mesh must outlive it. Errors: Error{input} where the shape is empty, or
  /// leaves the mesh and is not to be trimmed.
  PrescribedAdvection(const Mesh& mesh, vof::Motion motion, const shapes::Shape& shape,
                      bool trim = false);

  /// Collective. Step of the given Courant number at the interface, at most a hundredth of the
  /// period.
  Real stable_dt(Real courant) const;
  /// Collective. From t to t + dt, with the velocity of the middle of the step.
  void step(Real dt);

  /// The mesh.
  const Mesh& mesh() const { return mesh_; }
  /// The time reached.
  Real t() const { return t_; }
  /// Count of steps taken.
  std::int64_t steps() const { return steps_; }
  /// Fraction of the body.
  const CellField<Real>& alpha() const { return alpha_; }
  /// The velocity of the last step.
  const CellField<Vec3>& u() const { return u_; }
  /// Collective. sum |alpha - alpha at the start| V: the shape error, after a whole period.
  Real difference() const { return vof::difference(alpha_, start_, mesh_); }
  /// Figures of the last step.
  const vof::AdvectReport& report() const { return report_; }

 private:
  const Mesh& mesh_;
  vof::Motion motion_;
  CellField<Real> alpha_, start_;
  CellField<Vec3> u_1_, u_;
  FaceField<Real> phi_1_, phi_;
  vof::Interface interface_;
  vof::ReconstructScratch reconstruct_scratch_;
  vof::AdvectScratch advect_scratch_;
  vof::AdvectReport report_;
  Real t_ = 0;
  std::int64_t steps_ = 0;
};

/// Writes solid.csv (t, centroid, volume, its drift, the bounds of alpha, difference to the start),
/// fields, run.yaml and summary.json.
class PrescribedAdvectionOutput {
 public:
  /// Collective. Errors: Error{io}, Error{input} where another run holds the directory.
  PrescribedAdvectionOutput(const Case& setup, const Options& options,
                            const PrescribedAdvection& carried);

  /// Collective. Whether no signal and no time limit ends the run.
  bool go_on();
  /// Time at which the next step must end: the next field file.
  Real next_event() const { return field_.next(carried_.t()); }
  /// Collective. Writes what is due.
  void after_step();
  /// Collective. Writes the last files and returns how the run ended.
  RunStatus finish();

 private:
  Row row();
  void write_rows();
  void write_fields();
  void write_due();
  std::string summary_file() const { return case_.output.directory + "/summary.json"; }
  std::string summary(const std::string& status, const std::string& message = "") const;

  const Case& case_;
  const Options& options_;
  const PrescribedAdvection& carried_;
  io::Lock lock_;
  Samples samples_;
  Schedule field_;
  std::optional<io::Table> table_;
  std::optional<io::FieldWriter> fields_;
  analysis::Tracker tracker_;
  Real volume_0_ = 0, drift_ = 0, low_ = 0, high_ = 1, row_at_ = -1;
  Stopwatch watch_;
  bool interrupted_ = false;
};

}  // namespace fsi
