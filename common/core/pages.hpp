/// How the programs take memory from the system: in large pages, and for good.
///
/// A direct factorisation frees as much as it takes, again and again. By default the C library returns such
/// blocks to the system and gets them anew, page by page of 4 kB, which costs as long as the arithmetic of a
/// small case.
#pragma once

#include <cstddef>

namespace fpi {

/// Of this machine [bytes]; 0 where the system does not say.
std::size_t machine_memory();

/// From now on freed memory stays with the program and new memory comes in pages of 2 MB, where the system
/// has them (transparent_hugepage: madvise or always). Reserves addresses, not memory. Call it first in main.
void keep_pages();

/// Returns unused memory to the system where the machine has less left than this program keeps unused. Looks
/// at most once a second, so that it may be called after every step.
void return_pages_where_scarce();

}  // namespace fpi
