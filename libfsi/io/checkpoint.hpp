#pragma once
// Checkpoints: all that the next step depends on, readable on any number of ranks.

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/io/layout.hpp"

namespace fsi::io {

class Hdf5File;
class Hdf5Image;

/// What a checkpoint holds, by name, as references to where it lives: the same list serves to write
/// and to read. It holds as long as the fields keep their storage: a Field listed is never swapped.
class Snapshot {
 public:
  /// A number or word to be kept.
  using Scalar = std::variant<Real*, std::int64_t*, std::string*>;
  /// The storage of a field.
  struct Values {
    std::string name;     ///< in the file
    Location on;          ///< cells, faces or boundary
    int width;            ///< Reals per item
    Real* values;         ///< where they live
    std::string instead;  ///< as `add` has it
  };

  /// identity: properties beside the mesh that must be the same to continue from a checkpoint
  /// (driver, kinematics); "key=value" items that are compared as one text.
  explicit Snapshot(std::string identity = "") : identity_(std::move(identity)) {}

  /// instead: what to read where a checkpoint has no field of that name; "": it is refused.
  template <class T, Location on>
  void add(const std::string& name, Field<T, on>& field, const std::string& instead = "") {
    fields_.push_back({name, on, components<T>, reinterpret_cast<Real*>(field.data()), instead});
  }
  /// Adds a number or word.
  void add(const std::string& name, Scalar scalar) { scalars_.emplace_back(name, scalar); }
  /// The same for one that a checkpoint may lack: it then stays as it is.
  void add_optional(const std::string& name, Scalar scalar) {
    scalars_.emplace_back(name, scalar), optional_.insert(name);
  }

  /// As it was made with.
  const std::string& identity() const { return identity_; }
  /// The fields, in the order added.
  const std::vector<Values>& fields() const { return fields_; }
  /// Numbers and words, in the order added.
  const std::vector<std::pair<std::string, Scalar>>& scalars() const { return scalars_; }
  /// Whether a checkpoint may lack the number or word of that name.
  bool optional(const std::string& name) const { return optional_.contains(name); }

 private:
  std::string identity_;
  std::vector<Values> fields_;
  std::vector<std::pair<std::string, Scalar>> scalars_;
  std::set<std::string> optional_;
};

/// Collective. How much of a cell the solids fill in the newest sound checkpoint of a directory,
/// one value for each of `count` cells from number `first` on (Mesh::global_id). solids: their
/// names; one that it does not have fills nothing. Empty on all ranks if it has none of them.
std::vector<Real> solid_fractions(const std::string& directory,
                                  const std::vector<std::string>& solids, Index first, Index count);

/// The checkpoints checkpoint_NNNN.h5 of an output directory, of which the two newest are kept. A
/// file is whole or not there: HDF5, and behind it the length and CRC-64 of all before. The order
/// of values does not depend on the division of the mesh; every rank writes and reads its stretch.
class Checkpoint {
 public:
  /// Collective. Removes what an interrupted write left behind.
  Checkpoint(std::string directory, const Mesh& mesh);

  /// Removes the checkpoints of an earlier run. keep: but for the newest, which gets the ending
  /// ".before". Returns its new name; "" where there is none. Rank 0 alone.
  std::string clear(bool keep) const;

  /// Collective. Returns whether it was written. A disk that is full or forbids it is no error: a
  /// warning is printed, the older checkpoints stay and the run may continue. Errors:
  /// Error{numerics} when a value is not finite; nothing is then written.
  bool write(const Snapshot& snapshot);

  /// Collective. Fills what `snapshot` refers to, bit for bit, from the newest checkpoint that is
  /// sound; damaged ones are named in a warning and set aside. On return the halo cells are set
  /// too. Errors: Error{input} when there is none, or it is of another mesh, identity or list of
  /// names; Error{io} when all are damaged.
  /// advice: what the sentence says to do where there is none.
  void read(const Snapshot& snapshot, const std::string& advice = "choose another folder");

  /// The file last written or read; "" before.
  const std::string& file() const { return file_; }

 private:
  const Layout& layout(Location on) const;
  std::string path(std::int64_t number) const;
  void keep_two() const;
  std::uint64_t rows(Location on) const;
  std::string write_fields(const Snapshot& snapshot, const Hdf5Image* image,
                           std::vector<std::uint64_t>& offset) const;
  std::string rejection_reason(const Hdf5File& file, const Snapshot& snapshot) const;
  void load(const std::string& file, const Snapshot& snapshot) const;

  std::string directory_, file_;
  const Mesh& mesh_;
  Layout cells_, faces_, boundary_;
  std::int64_t next_ = 1;  ///< number of the next file
};

}  // namespace fsi::io
