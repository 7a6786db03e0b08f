#pragma once
// The memory that a program may have.

#include <cstdint>
#include <string>

namespace fsi {

/// Bytes that this process can have at most: the least of the machine's memory, of the limit on its
/// address space (ulimit -v) and of that of its control group.
std::uint64_t memory_limit();

/// Gives the memory that was freed back to the system where the allocator keeps it for later, as
/// that of Open MPI does. For the ends of stages that take much memory for a short time.
void release_freed_memory();

/// "1.5 GB": bytes in the unit of thousands that leaves at least one before the point.
std::string text_of_bytes(std::uint64_t bytes);

}  // namespace fsi
