#pragma once
// The memory that a program may have.

#include <cstdint>
#include <string>

namespace fsi {

/// Bytes that this process can have at most: the least of the machine's memory, of the limit on its
/// address space (ulimit -v) and of that of its control group.
std::uint64_t memory_limit();

/// "1.5 GB": bytes in the unit of thousands that leaves at least one before the point.
std::string text_of_bytes(std::uint64_t bytes);

}  // namespace fsi
