// The kinds of sky, and their words.
#pragma once

namespace vegard::fit {

/// The kinds, those with aurora first: a rayed arc below the Moon is a rayed arc.
enum class SkyKind {
  black,
  overhead,
  rayed,
  several_arcs,
  one_arc,
  diffuse,
  twilight,
  cloud,
  moon,
  lamps,
  clear
};
inline constexpr int kSkyKinds = 11;

/// "one_arc", as in tables.
const char* sky_kind_name(SkyKind kind);
/// "one arc", as in sentences.
const char* sky_kind_words(SkyKind kind);
/// True for overhead, rayed, several_arcs, one_arc and diffuse.
bool is_aurora(SkyKind kind);

}  // namespace vegard::fit
