#pragma once
// What the namespaces of libfsi hold: read by Doxygen alone.

/// \mainpage
/// A driver includes libfsi/fsi.hpp and uses the names of the namespace fsi. A loop of one's own
/// uses those of its modules too: fsi::flow, fsi::solid, fsi::vof. "Collective" says that all ranks
/// of a run must call a function; "Errors" says which exception it throws.

/// Soft solids in viscous flow on unstructured meshes: what a driver needs.
namespace fsi {
/// What is measured of a run: centroids, ellipses, rings, surfaces, probes.
namespace analysis {}
/// Flow: momentum, projection, openings and what loads them, mean velocity.
namespace flow {}
/// Pure geometry: cut cells, simplices, moments.
namespace geometry {}
/// Files: csv tables, fields for ParaView, checkpoints, HDF5.
namespace io {}
/// Signed distances of shapes.
namespace shapes {}
/// The solid: kinematics, laws, elastic force.
namespace solid {}
/// The interface: fractions, planes, transport.
namespace vof {}
}  // namespace fsi
