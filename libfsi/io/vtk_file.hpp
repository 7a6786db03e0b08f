#pragma once
// Common parts of all VTKHDF files of this library, and a file that is complete by itself.

#include <span>
#include <string>

#include "libfsi/io/hdf5.hpp"
#include "libfsi/io/vtk_mesh.hpp"

namespace fsi::io {

/// Makes /VTKHDF a group that VTK reads as an unstructured grid, format 1.0.
void head_vtk(Hdf5Image& image);

/// The mesh's datasets in /VTKHDF.
void add(Hdf5Image& image, const VtkMesh& mesh);

/// Collective. Rank 0's reason becomes everybody's Error{io} that names the file.
void agree(const std::string& file, const std::string& reason);

/// A figure of each of the cells that are written.
struct CellFigure {
  std::string name;              ///< in the file
  std::span<const Real> values;  ///< [owned cells]
};

/// Collective. Some of the owned cells of each rank with their figures and `cell`, the number in
/// the mesh as read (from 0), as one file that ParaView opens by itself. Errors: Error{io}.
void write_cells(const std::string& path, const Mesh& mesh, std::span<const Index> cells,
                 std::span<const CellFigure> figures);

}  // namespace fsi::io
