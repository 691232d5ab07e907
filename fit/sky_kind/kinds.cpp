#include "fit/sky_kind/kinds.h"

#include <array>
#include <cstddef>

namespace vegard::fit {
namespace kinds {
namespace {

struct Words {
  const char *name, *words;
};
constexpr std::array<Words, kSkyKinds> kWords = {{{"black", "a black frame, of a closed camera"},
                                                  {"overhead", "aurora overhead (a corona)"},
                                                  {"rayed", "rayed aurora"},
                                                  {"several_arcs", "several arcs"},
                                                  {"one_arc", "one arc"},
                                                  {"diffuse", "diffuse aurora"},
                                                  {"twilight", "twilight"},
                                                  {"cloud", "cloud"},
                                                  {"moon", "the Moon"},
                                                  {"lamps", "lamps or a town"},
                                                  {"clear", "a clear sky"}}};

}  // namespace
}  // namespace kinds

const char* sky_kind_name(SkyKind kind) { return kinds::kWords[static_cast<std::size_t>(kind)].name; }

const char* sky_kind_words(SkyKind kind) { return kinds::kWords[static_cast<std::size_t>(kind)].words; }

bool is_aurora(SkyKind kind) { return kind >= SkyKind::overhead && kind <= SkyKind::diffuse; }

}  // namespace vegard::fit
