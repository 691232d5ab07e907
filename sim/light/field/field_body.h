// The field of a patch at a place. This source is included into the ordinary namespace (for double and dual
// numbers; see sim/light/field/field_patch.h) and into that of every instruction set (for packs of floats).
// Therefore it has no include guard.

/// Transforms a coordinate on a face so that it is nearly proportional to the angle: the Padé approximant of
/// the arctangent.
template <class L>
VEGARD_INLINE L evened(const L& u) {
  const L square = u * u;
  return u * (L(15.0) + L(4.0) * square) / (L(15.0) + L(9.0) * square);
}

/// Computes the field. `c` is FieldPatch's `coefficient`, or `rounded` for packs of floats; x and y are
/// coordinates times per_place. Beyond the patch the field is that at its edge.
template <class L, class Number>
VEGARD_INLINE void field_of_patch(const Number* c, const L& x, const L& y, L field[3]) {
  const auto within = [](const L& place) {
    const L one(1.0), minus(-1.0);
    return select(value_of(place) < value_of(minus), minus,
                  select(value_of(one) < value_of(place), one, place));
  };
  const auto polynomials = [](const L& place, L of[kFieldDegree + 1]) {
    of[0] = L(1.0);
    of[1] = place;
    const L twice = place + place;
    for (int n = 2; n <= kFieldDegree; ++n) of[n] = twice * of[n - 1] - of[n - 2];
  };
  L poly_x[kFieldDegree + 1], poly_y[kFieldDegree + 1];
  polynomials(within(x), poly_x);
  polynomials(within(y), poly_y);
  for (int k = 0; k < 3; ++k) field[k] = L(0.0);
  int term = 0;
  for (int i = 0; i <= kFieldDegree; ++i) {
    L inner[3] = {L(0.0), L(0.0), L(0.0)};
    for (int j = 0; j <= kFieldDegree; ++j, ++term)
      for (int k = 0; k < 3; ++k) inner[k] = inner[k] + poly_y[j] * L(c[k * kFieldTerms + term]);
    for (int k = 0; k < 3; ++k) field[k] = field[k] + poly_x[i] * inner[k];
  }
}

/// Computes the direction in which electrons fall at `place`, a unit vector from the Earth's centre: along
/// the field if it points into the Earth, otherwise against it.
template <class L>
VEGARD_INLINE void fall_in_field(const L field[3], const L place[3], L along[3]) {
  const L up = place[0] * field[0] + place[1] * field[1] + place[2] * field[2];
  const L size = square_root(field[0] * field[0] + field[1] * field[1] + field[2] * field[2]);
  const L scale = L(1.0) / select(value_of(L(0.0)) < value_of(up), L(0.0) - size, size);
  for (int i = 0; i < 3; ++i) along[i] = field[i] * scale;
}
