#include "sim/scene/table/counterpart.h"

#include <algorithm>
#include <functional>
#include <variant>

#include "sim/scene/table/parameter_declarations.h"

namespace vegard::sim {
namespace {

/// Calls use(there, here) for every real number of both scenes at once.
template <class Use>
void for_each_pair(const Scene& from, const Scene& copy, const Use& use) {
  // Only read through: the accessors take a Scene they could change.
  Scene &here = const_cast<Scene&>(from), &there = const_cast<Scene&>(copy);
  for (const Declaration& d : declarations()) {
    const int elements = std::min(element_count(d, from), element_count(d, copy));
    for (int e = 0; e < elements; ++e) {
      const int components = std::min(component_count(d, from, e), component_count(d, copy, e));
      for (int c = 0; c < components; ++c) {
        const ValueRef value = d.at(here, e, c);
        double* const* const number = std::get_if<double*>(&value);
        if (number == nullptr) break;  // nor are the other components
        use(*number, std::get<double*>(d.at(there, e, c)));
      }
    }
  }
}

}  // namespace

std::vector<const double*> counterparts(const Scene& from, const std::vector<const double*>& addresses,
                                        const Scene& copy) {
  std::vector<const double*> found(addresses.size(), nullptr);
  if (addresses.empty()) return found;
  std::vector<std::size_t> order(addresses.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const std::less<const double*> before;
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return before(addresses[a], addresses[b]); });
  for_each_pair(from, copy, [&](const double* here, const double* there) {
    auto at = std::lower_bound(order.begin(), order.end(), here,
                               [&](std::size_t i, const double* p) { return before(addresses[i], p); });
    for (; at != order.end() && addresses[*at] == here; ++at) found[*at] = there;
  });
  return found;
}

double* counterpart(const Scene& from, const double* address, Scene& copy) {
  return const_cast<double*>(counterparts(from, {address}, copy).front());
}

}  // namespace vegard::sim
