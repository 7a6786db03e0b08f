#pragma once
// The elastic law of an incompressible isotropic solid, which follows from its energy alone.

#include <cmath>
#include <functional>
#include <span>
#include <string>

#include "libfsi/core/parallel.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/solid/law/jet.hpp"
#include "libfsi/solid/law/neo_hookean.hpp"

namespace fsi::solid {

/// The results of a law for one B, all over G.
struct Response {
  SymTensor T;       ///< tau = G dev(T)
  Real modulus = 0;  ///< lambda_B, rho c^2 of the fastest shear wave
  Real W = 0;        ///< energy per volume
  /// Whether B is within the range of the law: W is finite and waves are real.
  bool valid() const { return std::isfinite(W) && std::isfinite(modulus) && modulus > 0; }
};

/// With W and its derivatives by I1 = tr B and I2 = tr B^-1                 [Ogden97] 4.3, 6.2
///   T = 2 W_1 B - 2 W_2 B^-1
/// and, for waves along n that are polarised along n_p, n_p . n = 0 (n_perp of
/// doc/theory/stress.md),
///   lambda(n, n_p) = 2 W_1 n.B.n + 2 W_2 n_p.B^-1.n_p
///             + 4 W_11 (n_p.B.n)^2 - 8 W_12 (n_p.B.n) (n_p.B^-1.n) + 4 W_22 (n_p.B^-1.n)^2.
/// This is the second derivative of W by e in F -> (I + e n_p (x) n) F. The modulus lambda_B is its
/// largest value with n and n_p in the plane of the largest and the smallest stretch. If W_11, W_12
/// and W_22 are 0 or more and the solid is stiffest in this plane, it is the largest of all.
Response response(const Jet& W, const SymTensor& B);

/// B^(1/2); eigenvalues below 1e-6 count as that.
SymTensor root(const SymTensor& B);

/// A law, made from a function energy(I1, I2) that returns Jets: W over the shear modulus G at
/// rest. neo-Hookean by default. The function is called once for each cell, inside loops compiled
/// for its type.
class Law {
 public:
  Law() : Law(NeoHookean{}) {}
  /// One of this folder.
  template <class Shipped>
  explicit Law(const Shipped& shipped) : Law(Shipped::name, shipped) {}
  /// A law of your own. Errors: Error{input} if at rest W is not 0 or the shear modulus 2 (W_1 +
  /// W_2) is not 1.
  template <class Energy>
  Law(std::string name, const Energy& energy)
      : name_(std::move(name)),
        B_itself_(std::is_same_v<Energy, NeoHookean>),
        response_([energy](const SymTensor& B) { return response_of(energy, B); }),
        apply_([energy](const Fields& fields) { return loop(energy, fields); }),
        sum_([energy](Sum& sum, Real G, const CellField<SymTensor>& B, const CellField<Real>& alpha,
                      const Mesh& mesh) { sum_of(energy, sum, G, B, alpha, mesh); }) {
    check_at_rest();
  }

  /// Its name.
  const std::string& name() const { return name_; }
  /// Whether T is B itself, and the modulus the largest eigenvalue of B: `apply` is then not
  /// needed.
  bool B_itself() const { return B_itself_; }
  /// The results for one B, det B = 1.
  Response at(const SymTensor& B) const { return response_(B); }

  /// The fields of a law.
  struct Fields {
    CellField<SymTensor>& T;        ///< on return set on `cells`; zero where B is
    CellField<Real>& modulus;       ///< likewise
    const CellField<SymTensor>& B;  ///< of the body's cells, zero elsewhere
    const CellField<Real>& alpha;   ///< fraction of the solid
    std::span<const Index> cells;   ///< where B is set
    Real own;                       ///< the fraction from which on a cell is a known one
  };
  /// Sets T and modulus. Returns whether B is within the law's range in this rank's known cells. In
  /// all other cells a B beyond the range is replaced by the first of B^(1/2), B^(1/4), ... within
  /// it.
  bool apply(const Fields& fields) const { return apply_(fields); }

  /// Collective. Elastic energy, sum G alpha W V; in plane strain B_zz = 1.
  Real energy(Real G, const CellField<SymTensor>& B, const CellField<Real>& alpha,
              const Mesh& mesh) const;
  /// Adds this rank's part of it.
  void add_energy(Sum& sum, Real G, const CellField<SymTensor>& B, const CellField<Real>& alpha,
                  const Mesh& mesh) const {
    sum_(sum, G, B, alpha, mesh);
  }

 private:
  static constexpr int roots = 50;  // of B: the last one is I to rounding

  void check_at_rest() const;
  template <class Energy>
  static Jet value(const Energy& energy, const SymTensor& B) {
    return energy(Jet::first(trace(B)), Jet::second(trace(adjugate(B))));
  }
  template <class Energy>
  static Response response_of(const Energy& energy, const SymTensor& B) {
    return response(value(energy, B), B);
  }
  template <class Energy>
  static bool loop(const Energy& energy, const Fields& fields) {
    bool within = true;
    for (const Index c : fields.cells) {
      SymTensor B = fields.B[c];
      Response r;
      if (B != SymTensor{}) r = response_of(energy, B);
      if (B != SymTensor{} && !r.valid()) {
        within = within && fields.alpha[c] < fields.own;
        for (int i = 0; i < roots && !r.valid(); ++i) B = root(B), r = response_of(energy, B);
      }
      fields.T[c] = r.T, fields.modulus[c] = r.modulus;
    }
    return within;
  }
  template <class Energy>
  static void sum_of(const Energy& energy, Sum& sum, Real G, const CellField<SymTensor>& B_,
                     const CellField<Real>& alpha, const Mesh& mesh) {
    for (Index c = 0; c < mesh.n_owned; ++c) {
      if (!(alpha[c] > 0)) continue;
      SymTensor B = B_[c];
      Real W = value(energy, B).f;
      for (int i = 0; i < roots && !std::isfinite(W); ++i) B = root(B), W = value(energy, B).f;
      sum.add(G * alpha[c] * W * mesh.V[c]);
    }
  }

  std::string name_;
  bool B_itself_;
  std::function<Response(const SymTensor&)> response_;
  std::function<bool(const Fields&)> apply_;
  std::function<void(Sum&, Real, const CellField<SymTensor>&, const CellField<Real>&, const Mesh&)>
      sum_;
};

}  // namespace fsi::solid
