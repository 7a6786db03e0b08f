#include "libfsi/mesh/mesh_file.hpp"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>

#include "libfsi/core/error.hpp"
#include "libfsi/core/hdf5_handle.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/exchange.hpp"
#include "libfsi/mesh/messages.hpp"

namespace fsi {
namespace {

constexpr std::int64_t format = 1;

using Open = Hdf5Handle;
using Quiet = Hdf5Quiet;

template <class T>
hid_t type_of() {
  if constexpr (std::is_same_v<T, Real>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::int8_t>) return H5T_NATIVE_INT8;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  return H5T_NATIVE_INT64;
}

/// Rows of `width` values in chunks, each with its checksum.
template <class T>
bool put(hid_t group, const char* name, const std::vector<T>& values, hsize_t width) {
  const hsize_t rows = values.size() / width, dims[2] = {rows, width};
  const hsize_t chunk[2] = {std::clamp<hsize_t>(rows, 1, 32768), width};
  const Open space(H5Screate_simple(2, dims, nullptr), H5Sclose);
  const Open creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  if (H5Pset_chunk(creation, 2, chunk) < 0 || H5Pset_fletcher32(creation) < 0) return false;
  const Open set(H5Dcreate2(group, name, type_of<T>(), space, H5P_DEFAULT, creation, H5P_DEFAULT),
                 H5Dclose);
  return set.ok() && H5Dwrite(set, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0;
}

/// Rows [first, first + rows); whether the dataset has `total` of them, of that width.
template <class T>
bool take(hid_t group, const char* name, const Stretches& where, hsize_t width,
          std::vector<T>& values) {
  const Open set(H5Dopen2(group, name, H5P_DEFAULT), H5Dclose);
  if (!set.ok()) return false;
  const Open space(H5Dget_space(set), H5Sclose);
  hsize_t dims[2] = {0, 0};
  if (H5Sget_simple_extent_ndims(space) != 2 ||
      H5Sget_simple_extent_dims(space, dims, nullptr) != 2 || dims[1] != width ||
      dims[0] != static_cast<hsize_t>(where.size()))
    return false;
  const hsize_t first[2] = {static_cast<hsize_t>(where.first()), 0};
  const hsize_t count[2] = {static_cast<hsize_t>(where.mine()), width};
  values.resize(count[0] * count[1]);
  if (count[0] == 0) return true;
  const Open memory(H5Screate_simple(2, count, nullptr), H5Sclose);
  return H5Sselect_hyperslab(space, H5S_SELECT_SET, first, nullptr, count, nullptr) >= 0 &&
         H5Dread(set, type_of<T>(), memory, space, H5P_DEFAULT, values.data()) >= 0;
}

/// A one-dimensional attribute.
template <class T>
bool note(hid_t group, const char* name, const std::vector<T>& values) {
  const hsize_t n = values.size();
  const Open space(n > 0 ? H5Screate_simple(1, &n, nullptr) : H5Screate(H5S_NULL), H5Sclose);
  const Open made(H5Acreate2(group, name, type_of<T>(), space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return made.ok() && (n == 0 || H5Awrite(made, type_of<T>(), values.data()) >= 0);
}
template <class T>
bool noted(hid_t group, const char* name, std::vector<T>& values) {
  const Open held(H5Aopen(group, name, H5P_DEFAULT), H5Aclose);
  if (!held.ok()) return false;
  const Open space(H5Aget_space(held), H5Sclose);
  const hssize_t n = H5Sget_simple_extent_npoints(space);
  if (n < 0 || n > 1 << 20) return false;
  values.resize(static_cast<std::size_t>(n));
  return n == 0 || H5Aread(held, type_of<T>(), values.data()) >= 0;
}

/// Texts as one list of characters, each with its end.
std::vector<std::int8_t> letters(const std::vector<std::string>& texts) {
  std::vector<std::int8_t> all;
  for (const std::string& text : texts) {
    all.insert(all.end(), text.begin(), text.end());
    all.push_back('\n');
  }
  return all;
}
std::vector<std::string> texts(const std::vector<std::int8_t>& all) {
  std::vector<std::string> list;
  std::string text;
  for (const std::int8_t c : all) {
    if (c != '\n') text += static_cast<char>(c);
    if (c == '\n') list.push_back(std::exchange(text, ""));
  }
  return list;
}

/// The corners of all cells in rows as long as the longest; -1 fills what a cell does not have.
std::vector<std::int32_t> padded(const CellList& whole, std::size_t width) {
  std::vector<std::int32_t> rows(whole.types.size() * width, -1);
  for (Index c = 0; c < whole.n_cells(); ++c) {
    std::ranges::copy(whole.corners[c], rows.begin() + static_cast<std::ptrdiff_t>(width) * c);
  }
  return rows;
}

/// The content of a file apart from cells and points.
struct Head {
  std::vector<std::int64_t> numbers;  // format, dim, cells, points, hash, corners a row
  std::vector<Real> periods;
  std::vector<std::int8_t> patches, periodic;
};

bool read_head(hid_t group, Head& head) {
  return noted(group, "numbers", head.numbers) && head.numbers.size() == 6 &&
         head.numbers[0] == format && noted(group, "periods", head.periods) &&
         head.periods.size() % 3 == 0 && noted(group, "patches", head.patches) &&
         noted(group, "periodic", head.periodic);
}

/// "" or what is wrong with the stretch, whose corners still stand in rows.
std::string fill(CellList& slab, const std::vector<std::int8_t>& types,
                 const std::vector<std::int32_t>& rows, std::size_t width, Index n_points) {
  for (std::size_t c = 0; c < types.size(); ++c) {
    if (types[c] < 0 || static_cast<std::size_t>(types[c]) >= shapes_of_cells.size())
      return "unknown type of cell";
    const auto type = static_cast<CellType>(types[c]);
    const auto n = static_cast<std::size_t>(shape_of(type).corners);
    if (shape_of(type).dim != slab.dim || n > width) return "a cell of the wrong dimension";
    const auto first = rows.begin() + static_cast<std::ptrdiff_t>(c * width);
    const auto last = first + static_cast<std::ptrdiff_t>(n);
    if (std::any_of(first, last, [&](Index p) { return p < 0 || p >= n_points; }))
      return "a cell names a point that is not there";
    slab.types.push_back(type);
    slab.corners.index.insert(slab.corners.index.end(), first, last);
    slab.corners.offset.push_back(static_cast<Index>(slab.corners.index.size()));
  }
  const auto patches = static_cast<std::int8_t>(slab.patches.size());
  for (const auto& cell : slab.face_patch) {
    if (std::ranges::any_of(cell, [&](std::int8_t p) { return p < -1 || p >= patches; }))
      return "a face names a patch that is not there";
  }
  const auto bad = [&](Index v) { return v < 0 || v >= n_points; };
  if (std::ranges::any_of(slab.vertex, bad)) return "a point is joined to one that is not there";
  return "";
}

/// "" or what is wrong with the file.
std::string read(const std::string& file, const std::vector<std::string>& periodic,
                 CellList& slab) {
  const Quiet quiet;
  const Open access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  if (H5Pset_file_locking(access, 0, 1) < 0) return "HDF5 fails";
  const Open opened(H5Fopen(file.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
  if (!opened.ok()) return "cannot be opened, or is no HDF5 file";
  const Open group(H5Gopen2(opened, "/fsi", H5P_DEFAULT), H5Gclose);
  Head head;
  if (!group.ok() || !read_head(group, head)) return "is not one of fsi-mesh convert";
  constexpr std::int64_t most = std::int64_t{1} << 28;  // Index counts faces of cells
  const std::int64_t n_cells = head.numbers[2], n_points = head.numbers[3];
  const auto width = static_cast<std::size_t>(head.numbers[5]);
  if (n_cells < 1 || n_cells > most || n_points < 1 || n_points > most || width > max_corners)
    return "is damaged: its counts make no sense";
  const std::vector<std::string> joined = texts(head.periodic);
  if (!periodic.empty() && periodic != joined)
    return "was converted with " +
           (joined.empty() ? "no periodic patches" : "the periodic patches " + text_of(joined)) +
           ", asked for are " + text_of(periodic) +
           "; leave out -mesh_periodic or convert the mesh anew";
  slab.dim = static_cast<int>(head.numbers[1]), slab.n_global = n_cells;
  slab.hash = static_cast<std::uint64_t>(head.numbers[4]), slab.patches = texts(head.patches);
  for (std::size_t i = 0; i < head.periods.size(); i += 3) {
    slab.periods.push_back({head.periods[i], head.periods[i + 1], head.periods[i + 2]});
  }
  const auto cells = Stretches::even(static_cast<Index>(n_cells));
  const auto points = Stretches::even(static_cast<Index>(n_points));
  std::vector<std::int8_t> types, face_patch, offset;
  std::vector<std::int32_t> rows;
  std::vector<Real> x;
  if (!take(group, "types", cells, 1, types) || !take(group, "corners", cells, width, rows) ||
      !take(group, "face_patch", cells, max_faces, face_patch) ||
      !take(group, "points", points, 3, x) || !take(group, "vertex", points, 1, slab.vertex) ||
      !take(group, "offset", points, 3, offset))
    return "is damaged: a table is missing or its checksum is wrong";
  for (std::size_t i = 0; i < x.size(); i += 3) {
    slab.points.push_back({x[i], x[i + 1], x[i + 2]});
    slab.offset.push_back({offset[i], offset[i + 1], offset[i + 2]});
  }
  slab.face_patch.resize(types.size());
  for (std::size_t i = 0; i < face_patch.size(); ++i) {
    slab.face_patch[i / max_faces][i % max_faces] = face_patch[i];
  }
  const std::string fault = fill(slab, types, rows, width, static_cast<Index>(n_points));
  return fault.empty() ? "" : "is damaged: " + fault;
}

bool write(hid_t file, const CellList& whole, const std::vector<std::string>& periodic) {
  const Open group(H5Gcreate2(file, "/fsi", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  if (!group.ok()) return false;
  std::size_t width = 0;
  for (const CellType type : whole.types) {
    width = std::max(width, static_cast<std::size_t>(shape_of(type).corners));
  }
  std::vector<std::int8_t> types, face_patch, offset;
  std::vector<Real> x, periods;
  for (const CellType type : whole.types) types.push_back(static_cast<std::int8_t>(type));
  for (const auto& cell : whole.face_patch) {
    face_patch.insert(face_patch.end(), cell.begin(), cell.end());
  }
  for (const Offset& o : whole.offset) offset.insert(offset.end(), o.begin(), o.end());
  for (const Vec3& p : whole.points) x.insert(x.end(), {p.x, p.y, p.z});
  for (const Vec3& p : whole.periods) periods.insert(periods.end(), {p.x, p.y, p.z});
  return put(group, "types", types, 1) && put(group, "corners", padded(whole, width), width) &&
         put(group, "face_patch", face_patch, max_faces) && put(group, "points", x, 3) &&
         put(group, "vertex", whole.vertex, 1) && put(group, "offset", offset, 3) &&
         note(group, "periods", periods) && note(group, "patches", letters(whole.patches)) &&
         note(group, "periodic", letters(periodic)) &&
         note(group, "numbers",
              std::vector<std::int64_t>{format, whole.dim, whole.n_cells(),
                                        static_cast<std::int64_t>(whole.points.size()),
                                        static_cast<std::int64_t>(whole.hash),
                                        static_cast<std::int64_t>(width)});
}

}  // namespace

bool is_mesh_file(const std::string& file) { return file.ends_with(".h5"); }

void write_mesh_tables(const std::string& file, const CellList& whole,
                       const std::vector<std::string>& periodic) {
  const Quiet quiet;
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  bool good = opened >= 0 && write(opened, whole, periodic);
  if (opened >= 0) good = H5Fclose(opened) >= 0 && good;
  if (!good) throw Error(ErrorKind::io, "mesh file \"" + file + "\" cannot be written");
}

CellList read_mesh_tables(const std::string& file, const std::vector<std::string>& periodic) {
  CellList slab;
  const std::string fault = read(file, periodic, slab);
  // The message of the lowest rank that has one, for all ranks.
  int teller = fault.empty() ? ranks() : rank();
  MPI_Allreduce(MPI_IN_PLACE, &teller, 1, MPI_INT, MPI_MIN, comm());
  if (teller == ranks()) return slab;
  throw Error(ErrorKind::input, "mesh file \"" + file + "\" " + broadcast(fault, teller));
}

}  // namespace fsi
