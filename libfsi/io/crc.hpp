#pragma once
// Cyclic redundancy check of 64 bits (polynomial of ECMA-182, reflected, as in the xz format).

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace fsi::io {

namespace detail {

/// The remainders of all bytes.
constexpr std::array<std::uint64_t, 256> crc_table() {
  constexpr std::uint64_t polynomial = 0xc96c5795d7870f42ULL;
  std::array<std::uint64_t, 256> table{};
  for (std::uint64_t i = 0; i < table.size(); ++i) {
    std::uint64_t value = i;
    for (int bit = 0; bit < 8; ++bit) value = (value >> 1) ^ ((value & 1) != 0 ? polynomial : 0);
    table[i] = value;
  }
  return table;
}

}  // namespace detail

/// The check of what gave `before`, continued by `bytes`; "123456789" gives 0x995dc9bbdf1939fa.
inline std::uint64_t crc64(std::span<const std::byte> bytes, std::uint64_t before = 0) {
  static constexpr std::array<std::uint64_t, 256> table = detail::crc_table();
  std::uint64_t crc = ~before;
  for (const std::byte b : bytes)
    crc = table[(crc ^ static_cast<std::uint8_t>(b)) & 0xff] ^ (crc >> 8);
  return ~crc;
}

/// The check of a followed by b, from the checks of both and the length of b in bytes. One step of
/// the check for a zero bit is linear, so the steps of all bits of b are a power of its matrix
/// [zlib].
inline std::uint64_t crc64_joined(std::uint64_t a, std::uint64_t b, std::uint64_t length) {
  using Matrix = std::array<std::uint64_t, 64>;
  const auto apply = [](const Matrix& m, std::uint64_t v) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < 64; ++i) sum ^= ((v >> i) & 1) != 0 ? m[i] : 0;
    return sum;
  };
  const auto squared = [&](const Matrix& m) {
    Matrix result;
    for (std::size_t i = 0; i < 64; ++i) result[i] = apply(m, m[i]);
    return result;
  };
  Matrix power;  // of one zero bit
  for (std::size_t i = 0; i < 64; ++i) {
    const std::uint64_t v = std::uint64_t{1} << i;
    power[i] = (v >> 1) ^ ((v & 1) != 0 ? 0xc96c5795d7870f42ULL : 0);
  }
  for (int i = 0; i < 3; ++i) power = squared(power);  // of a byte
  for (; length > 0; length >>= 1, power = squared(power)) {
    if ((length & 1) != 0) a = apply(power, a);
  }
  return a ^ b;
}

}  // namespace fsi::io
