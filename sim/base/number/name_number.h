// A hash of a name: the stream of random numbers of the object that has this name.
#pragma once

#include <cstdint>
#include <string>

namespace vegard::sim {

/// FNV-1a of 32 bits (Fowler, Noll and Vo; IETF draft-eastlake-fnv). By its name a thing keeps its noise when
/// others come and go before it in the scene.
inline std::uint32_t name_number(const std::string& name) {
  std::uint32_t hash = 2166136261u;
  for (const char letter : name) hash = (hash ^ static_cast<unsigned char>(letter)) * 16777619u;
  return hash;
}

}  // namespace vegard::sim
