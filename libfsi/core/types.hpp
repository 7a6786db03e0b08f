#pragma once
// Scalars, vectors and tensors of the library: plain aggregates that live in flat arrays.

#include <cmath>
#include <cstdint>

namespace fsi {

/// The floating-point number of all fields.
using Real = double;
using Index = std::int32_t;        ///< local cell, face or point number
using GlobalIndex = std::int64_t;  ///< number that is the same on any count of ranks

/// A vector (x, y, z); z = 0 in a 2-D run.
struct Vec3 {
  Real x = 0, y = 0, z = 0;  ///< components

  ///@{
  /// Component i: 0 is x, 1 is y, 2 is z.
  constexpr Real& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
  constexpr Real operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  ///@}
  ///@{
  /// Component by component.
  constexpr Vec3& operator+=(const Vec3& b) { return x += b.x, y += b.y, z += b.z, *this; }
  constexpr Vec3& operator-=(const Vec3& b) { return x -= b.x, y -= b.y, z -= b.z, *this; }
  constexpr Vec3& operator*=(Real s) { return x *= s, y *= s, z *= s, *this; }
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
  ///@}
};

///@{
/// Component by component.
constexpr Vec3 operator+(Vec3 a, const Vec3& b) { return a += b; }
constexpr Vec3 operator-(Vec3 a, const Vec3& b) { return a -= b; }
constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(Real s, Vec3 a) { return a *= s; }
constexpr Vec3 operator*(Vec3 a, Real s) { return a *= s; }
constexpr Vec3 operator/(Vec3 a, Real s) { return a *= 1 / s; }
///@}
/// a_i b_i.
constexpr Real dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
/// The vector product a x b.
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// |a|^2.
constexpr Real norm2(const Vec3& a) { return dot(a, a); }
/// |a|.
inline Real norm(const Vec3& a) { return std::sqrt(norm2(a)); }

/// A full tensor, row by row: `L.xy` is row x, column y; for the velocity gradient L.xy = du_x/dy.
struct Tensor {
  /// Components, row then column.
  Real xx = 0, xy = 0, xz = 0, yx = 0, yy = 0, yz = 0, zx = 0, zy = 0, zz = 0;

  ///@{
  /// Component by component.
  constexpr Tensor& operator+=(const Tensor& b) {
    xx += b.xx, xy += b.xy, xz += b.xz, yx += b.yx, yy += b.yy, yz += b.yz;
    zx += b.zx, zy += b.zy, zz += b.zz;
    return *this;
  }
  constexpr Tensor& operator*=(Real s) {
    xx *= s, xy *= s, xz *= s, yx *= s, yy *= s, yz *= s, zx *= s, zy *= s, zz *= s;
    return *this;
  }
  friend constexpr bool operator==(const Tensor&, const Tensor&) = default;
  ///@}
};

///@{
/// Component by component.
constexpr Tensor operator+(Tensor a, const Tensor& b) { return a += b; }
constexpr Tensor operator*(Real s, Tensor a) { return a *= s; }
///@}
/// (a b)_ij = a_i b_j.
constexpr Tensor outer(const Vec3& a, const Vec3& b) {
  return {a.x * b.x, a.x * b.y, a.x * b.z, a.y * b.x, a.y * b.y,
          a.y * b.z, a.z * b.x, a.z * b.y, a.z * b.z};
}
/// (t a)_i = t_ij a_j.
constexpr Vec3 dot(const Tensor& t, const Vec3& a) {
  return {t.xx * a.x + t.xy * a.y + t.xz * a.z, t.yx * a.x + t.yy * a.y + t.yz * a.z,
          t.zx * a.x + t.zy * a.y + t.zz * a.z};
}
/// t_ji.
constexpr Tensor transpose(const Tensor& t) {
  return {t.xx, t.yx, t.zx, t.xy, t.yy, t.zy, t.xz, t.yz, t.zz};
}
/// t_ii.
constexpr Real trace(const Tensor& t) { return t.xx + t.yy + t.zz; }
/// (a b)_ij = a_ik b_kj.
constexpr Tensor dot(const Tensor& a, const Tensor& b) {
  const Vec3 x = dot(a, Vec3{b.xx, b.yx, b.zx}), y = dot(a, Vec3{b.xy, b.yy, b.zy}),
             z = dot(a, Vec3{b.xz, b.yz, b.zz});  // columns
  return {x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z};
}
/// The determinant.
constexpr Real det(const Tensor& m) {
  return m.xx * (m.yy * m.zz - m.yz * m.zy) - m.xy * (m.yx * m.zz - m.yz * m.zx) +
         m.xz * (m.yx * m.zy - m.yy * m.zx);
}
/// By cofactors; det not zero.
constexpr Tensor inverse(const Tensor& m) {
  const Real s = 1 / det(m);
  return {s * (m.yy * m.zz - m.yz * m.zy), s * (m.xz * m.zy - m.xy * m.zz),
          s * (m.xy * m.yz - m.xz * m.yy), s * (m.yz * m.zx - m.yx * m.zz),
          s * (m.xx * m.zz - m.xz * m.zx), s * (m.xz * m.yx - m.xx * m.yz),
          s * (m.yx * m.zy - m.yy * m.zx), s * (m.xy * m.zx - m.xx * m.zy),
          s * (m.xx * m.yy - m.xy * m.yx)};
}

/// A symmetric tensor, upper triangle.
struct SymTensor {
  Real xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;  ///< components of the upper triangle

  ///@{
  /// Component by component.
  constexpr SymTensor& operator+=(const SymTensor& b) {
    xx += b.xx, xy += b.xy, xz += b.xz, yy += b.yy, yz += b.yz, zz += b.zz;
    return *this;
  }
  constexpr SymTensor& operator-=(const SymTensor& b) {
    xx -= b.xx, xy -= b.xy, xz -= b.xz, yy -= b.yy, yz -= b.yz, zz -= b.zz;
    return *this;
  }
  constexpr SymTensor& operator*=(Real s) {
    xx *= s, xy *= s, xz *= s, yy *= s, yz *= s, zz *= s;
    return *this;
  }
  friend constexpr bool operator==(const SymTensor&, const SymTensor&) = default;
  ///@}
};

///@{
/// Component by component.
constexpr SymTensor operator+(SymTensor a, const SymTensor& b) { return a += b; }
constexpr SymTensor operator-(SymTensor a, const SymTensor& b) { return a -= b; }
constexpr SymTensor operator*(Real s, SymTensor a) { return a *= s; }
///@}
/// (t a)_i = t_ij a_j.
constexpr Vec3 dot(const SymTensor& t, const Vec3& a) {
  return {t.xx * a.x + t.xy * a.y + t.xz * a.z, t.xy * a.x + t.yy * a.y + t.yz * a.z,
          t.xz * a.x + t.yz * a.y + t.zz * a.z};
}
/// (a b)_ij = a_ik b_kj.
constexpr Tensor dot(const Tensor& a, const SymTensor& b) {
  const Vec3 x = dot(b, Vec3{a.xx, a.xy, a.xz}), y = dot(b, Vec3{a.yx, a.yy, a.yz}),
             z = dot(b, Vec3{a.zx, a.zy, a.zz});  // rows
  return {x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z};
}
/// (a a)_ij = a_i a_j.
constexpr SymTensor square(const Vec3& a) {
  return {a.x * a.x, a.x * a.y, a.x * a.z, a.y * a.y, a.y * a.z, a.z * a.z};
}
/// (a b + b a)_ij = a_i b_j + b_i a_j.
constexpr SymTensor both_ways(const Vec3& a, const Vec3& b) {
  return {2 * a.x * b.x, a.x * b.y + a.y * b.x, a.x * b.z + a.z * b.x,
          2 * a.y * b.y, a.y * b.z + a.z * b.y, 2 * a.z * b.z};
}
/// a : b = a_ij b_ij.
constexpr Real contract(const SymTensor& a, const SymTensor& b) {
  return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + 2 * (a.xy * b.xy + a.xz * b.xz + a.yz * b.yz);
}
/// t_ii.
constexpr Real trace(const SymTensor& t) { return t.xx + t.yy + t.zz; }
/// The determinant.
constexpr Real det(const SymTensor& t) {
  return t.xx * (t.yy * t.zz - t.yz * t.yz) - t.xy * (t.xy * t.zz - t.yz * t.xz) +
         t.xz * (t.xy * t.yz - t.yy * t.xz);
}
/// det(t) times the inverse.
constexpr SymTensor adjugate(const SymTensor& t) {
  return {t.yy * t.zz - t.yz * t.yz, t.xz * t.yz - t.xy * t.zz, t.xy * t.yz - t.xz * t.yy,
          t.xx * t.zz - t.xz * t.xz, t.xz * t.xy - t.xx * t.yz, t.xx * t.yy - t.xy * t.xy};
}
/// By cofactors; det not zero.
constexpr SymTensor inverse(const SymTensor& t) { return (1 / det(t)) * adjugate(t); }
/// Deviator a - (tr a / 3) I.
constexpr SymTensor dev(SymTensor t) {
  const Real m = trace(t) / 3;
  t.xx -= m, t.yy -= m, t.zz -= m;
  return t;
}
/// The unit tensor.
constexpr SymTensor identity() { return {1, 0, 0, 1, 0, 1}; }

/// Count of Reals in a field's value type: Real 1, Vec3 3, SymTensor 6, Tensor 9.
template <class T>
inline constexpr int components = static_cast<int>(sizeof(T) / sizeof(Real));

}  // namespace fsi
