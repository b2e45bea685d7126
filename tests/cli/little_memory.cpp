// SPDX-License-Identifier: LGPL-3.0-or-later
// A library to be loaded before a program (LD_PRELOAD): allocations fail, as where memory is used up.
// Variables: CELLWALK_FAILS_AT, the number of the first one that does, counted from 1; CELLWALK_FAILS_ONCE,
// if only this one does; CELLWALK_COUNTS_IN, a file that gets how many there were.
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
}

namespace {

std::atomic<long> count{0};
long fails_at = 0;
bool fails_once = false;

[[gnu::constructor]] void begin() {
  const char* const at = std::getenv("CELLWALK_FAILS_AT");
  fails_once = std::getenv("CELLWALK_FAILS_ONCE") != nullptr;
  count = 0;
  fails_at = at == nullptr ? 0 : std::atol(at);
}

[[gnu::destructor]] void end() {
  const char* const file = std::getenv("CELLWALK_COUNTS_IN");
  if (file == nullptr) return;
  const long all = count;
  std::FILE* const out = std::fopen(file, "w");
  std::fprintf(out, "%ld", all);
  std::fclose(out);
}

bool fails() {
  const long number = ++count;
  if (fails_at == 0 || number < fails_at || (fails_once && number > fails_at)) return false;
  errno = ENOMEM;
  return true;
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) { return fails() ? nullptr : __libc_malloc(size); }
void* calloc(std::size_t number, std::size_t size) { return fails() ? nullptr : __libc_calloc(number, size); }
void* realloc(void* old, std::size_t size) { return fails() ? nullptr : __libc_realloc(old, size); }
void* memalign(std::size_t alignment, std::size_t size) {
  return fails() ? nullptr : __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }
int posix_memalign(void** result, std::size_t alignment, std::size_t size) {
  *result = memalign(alignment, size);
  return *result == nullptr ? ENOMEM : 0;
}

}  // extern "C"
