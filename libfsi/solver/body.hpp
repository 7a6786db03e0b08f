#pragma once
// A soft solid and what moves it: everything a scene without solid does not have.

#include <algorithm>

#include "libfsi/field/band.hpp"
#include "libfsi/shapes/shapes.hpp"
#include "libfsi/solid/left_cauchy_green.hpp"
#include "libfsi/solid/neo_hookean.hpp"
#include "libfsi/vof/advect.hpp"
#include "libfsi/vof/fill.hpp"
#include "libfsi/vof/reconstruct.hpp"

namespace fsi {

/// The solid's unknowns and the parts of the scheme that work on them.
struct Body {
  /// Collective. Fills the undeformed shape.
  Body(const Mesh& mesh, const shapes::Shape& shape, Real G)
      : alpha(mesh),
        Bt(mesh),
        interface(mesh),
        reconstruct_scratch(mesh),
        advect_scratch(mesh),
        band(mesh),
        kinematics(mesh),
        law(mesh, G),
        grad(mesh),
        filled(vof::fill(alpha, mesh, shape)) {
    solid::set_undeformed(Bt, alpha, mesh);
    band.rebuild(alpha, solid::alpha_min);
    vof::reconstruct(interface, alpha, mesh, reconstruct_scratch);
  }

  CellField<Real> alpha;     ///< volume fraction of the solid
  CellField<SymTensor> Bt;   ///< alpha^(1/2) B
  vof::Interface interface;  ///< planes of alpha
  vof::ReconstructScratch reconstruct_scratch;
  vof::AdvectScratch advect_scratch;
  Band band;  ///< of alpha >= alpha_min
  solid::LeftCauchyGreen kinematics;
  solid::NeoHookean law;
  CellField<solid::SymGradient> grad;  ///< scratch of both
  vof::Filled filled;                  ///< volume and its error at the start
  vof::AdvectReport advected;          ///< of the last step
};

}  // namespace fsi
