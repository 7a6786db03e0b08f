#pragma once
// Cyclic redundancy check of 64 bits (polynomial of ECMA-182, reflected, as in the xz format).

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace fsi::io {

namespace detail {

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

}  // namespace fsi::io
