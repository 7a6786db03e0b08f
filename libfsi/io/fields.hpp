#pragma once
// Fields for ParaView: VTKHDF 1.0, one file a time, the mesh stored once.

#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/io/layout.hpp"

namespace fsi::io {

class Hdf5Image;

/// Values of the owned cells under a name, `width` Reals each: 1, 3 (vector), 6 (SymTensor) or 9.
struct NamedField {
  std::string name;    ///< in the file
  int width;           ///< Reals per cell
  const Real* values;  ///< of the owned cells
};

/// A cell field under its name.
template <class T>
NamedField named(const std::string& name, const CellField<T>& field) {
  return {name, components<T>, reinterpret_cast<const Real*>(field.data())};
}

/// Writes fields_mesh.hdf once, fields_NNNN.hdf for each time (which links to the mesh) and
/// fields.hdf.series, the file to open, which lists them by time. Cells are in the order of the
/// mesh as read for any number of ranks; the components of a SymTensor as ParaView names them: XX
/// YY ZZ XY YZ XZ.
class FieldWriter {
 public:
  /// Collective. Takes up the series in the directory up to time resume_at and removes what lies
  /// beyond; without resume_at all of it. Errors: Error{io}.
  FieldWriter(std::string directory, const Mesh& mesh,
              Real resume_at = -std::numeric_limits<Real>::infinity());

  /// Collective. The last time, given again, takes its own place. Errors: Error{numerics} naming
  /// field, cell and place of a value that is not finite: nothing is then written. Error{io} when
  /// the file cannot be written; the series is as it was.
  void write(Real t, std::span<const NamedField> fields);

 private:
  struct Entry {
    std::string file;
    Real t;
  };
  void write_mesh() const;
  std::string write_cells(const std::string& path, std::span<const NamedField> fields,
                          const Hdf5Image* image, std::vector<std::uint64_t>& offset) const;
  void take_up(Real resume_at);
  std::string series() const;

  std::string directory_;
  const Mesh& mesh_;
  Layout cells_;
  std::vector<Entry> entries_;
};

}  // namespace fsi::io
