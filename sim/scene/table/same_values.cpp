#include "sim/scene/table/same_values.h"

#include <cstring>
#include <type_traits>
#include <variant>

#include "sim/scene/table/parameter_declarations.h"

namespace vegard::sim {
namespace {

// By their bits, so that a NaN is itself and -0 is not 0.
bool same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }  // NOLINT
template <class T>
bool same(const T& a, const T& b) {
  return a == b;
}

bool same_value(const ValueRef& a, const ValueRef& b) {
  return std::visit(
      [&](const auto& value) {
        using Ref = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<Ref, KindRef>)
          return value.number() == std::get<KindRef>(b).number();
        else
          return same(*value, *std::get<Ref>(b));
      },
      a);
}

}  // namespace

bool same_values(const Scene& a, const Scene& b, const std::set<std::string>& except) {
  if (a.file != b.file || a.tables != b.tables || a.emission.folder != b.emission.folder) return false;
  // Only read through: the accessors take a Scene they could change.
  Scene &one = const_cast<Scene&>(a), &other = const_cast<Scene&>(b);
  for (const Declaration& d : declarations()) {
    if (except.count(d.table) > 0) continue;
    const int elements = element_count(d, a);
    if (elements != element_count(d, b)) return false;
    for (int e = 0; e < elements; ++e) {
      const int components = component_count(d, a, e);
      if (components != component_count(d, b, e)) return false;
      for (int c = 0; c < components; ++c)
        if (!same_value(d.at(one, e, c), d.at(other, e, c))) return false;
    }
  }
  return true;
}

}  // namespace vegard::sim
