#include "fit/map/sequence/sparse_map.h"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace vegard::fit {

SparseMap::SparseMap(const std::vector<float>& map) {
  for (std::size_t i = 0; i < map.size(); ++i)
    if (map[i] != 0.0f) {
      place.push_back(static_cast<double>(i));
      value.push_back(map[i]);
    }
}

std::vector<float> SparseMap::whole(std::size_t numbers) const {
  std::vector<float> map(numbers, 0.0f);
  for (std::size_t i = 0; i < place.size(); ++i)
    map[static_cast<std::size_t>(place[i])] = static_cast<float>(value[i]);
  return map;
}

void SparseMap::store(StepOutput& out, const std::string& name) const {
  std::vector<double>& packed = out.numbers[name];
  for (std::size_t i = 0; i < place.size(); ++i) {
    const auto lit = static_cast<float>(value[i]);
    std::uint32_t bits = 0;
    std::memcpy(&bits, &lit, sizeof bits);
    const std::uint64_t both = (static_cast<std::uint64_t>(place[i]) << 32u) | bits;
    double number = 0.0;
    std::memcpy(&number, &both, sizeof number);
    packed.push_back(number);
  }
}

SparseMap SparseMap::stored(const StepOutput& out, const std::string& name, std::size_t numbers) {
  SparseMap map;
  for (const double number : out.numbers_at(name)) {
    std::uint64_t both = 0;
    std::memcpy(&both, &number, sizeof both);
    const auto bits = static_cast<std::uint32_t>(both);
    float lit = 0.0f;
    std::memcpy(&lit, &bits, sizeof lit);
    const std::uint64_t at = both >> 32u;
    if (at >= numbers || !(lit >= 0.0f) || !std::isfinite(lit)) throw out.error_at(name);
    map.place.push_back(static_cast<double>(at));
    map.value.push_back(lit);
  }
  return map;
}

}  // namespace vegard::fit
