/// @file
/// Stands in for malloc and counts its calls, in a program that includes this in one source. Not
/// under a sanitizer, which stands in for malloc itself.
#pragma once

#include <atomic>
#include <cerrno>
#include <cstdlib>

namespace {

std::atomic<long> allocations{0};

/// What `work` allocates. Called before CHECK, which allocates.
long allocations_of(const auto& work) {
  const long before = allocations;
  work();
  return allocations - before;
}

}  // namespace

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  *memory = memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}
}
