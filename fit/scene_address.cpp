#include "fit/scene_address.h"

#include <cstddef>
#include <functional>

namespace vegard::fit {
namespace {

template <class Whole>
double* inside(Whole& copy, const Whole& from, const double* address) {
  const char *at = reinterpret_cast<const char*>(address), *begin = reinterpret_cast<const char*>(&from);
  const std::less<const char*> before;
  if (before(at, begin) || !before(at, begin + sizeof(Whole))) return nullptr;
  return reinterpret_cast<double*>(reinterpret_cast<char*>(&copy) + (at - begin));
}

}  // namespace

double* number_in(sim::Scene& copy, const sim::Scene& from, const double* address) {
  for (std::size_t s = 0; s < from.sheets.size(); ++s)
    if (double* found = inside(copy.sheets[s], from.sheets[s], address)) return found;
  for (std::size_t l = 0; l < from.blur.width_deg.size(); ++l)
    if (address == &from.blur.width_deg[l]) return &copy.blur.width_deg[l];
  return inside(copy, from, address);
}

}  // namespace vegard::fit
