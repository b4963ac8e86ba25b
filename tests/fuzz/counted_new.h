// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

// A program that links counted_new.cpp has its operator new and delete from there: they count what is held.
namespace lacuna::fuzz {

/// Bytes that operator new gave and operator delete has not had back.
std::size_t held();
/// The most that was held since count_most_anew().
std::size_t most_held();
void count_most_anew();
/// From now on operator new throws std::bad_alloc rather than let more be held.
void limit_held(std::size_t bytes);

} // namespace lacuna::fuzz
