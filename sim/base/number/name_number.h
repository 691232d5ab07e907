// A hash of a name: the stream of random numbers of the object that has this name.
#pragma once

#include <cstdint>
#include <string>

namespace vegard::sim {

/// Returns the 32-bit FNV-1a hash (Fowler, Noll and Vo; IETF draft-eastlake-fnv). With a stream by name, an
/// object keeps its noise when others are added or removed before it in the scene.
inline std::uint32_t name_number(const std::string& name) {
  std::uint32_t hash = 2166136261u;
  for (const char letter : name) hash = (hash ^ static_cast<unsigned char>(letter)) * 16777619u;
  return hash;
}

}  // namespace vegard::sim
