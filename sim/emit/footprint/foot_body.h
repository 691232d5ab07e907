// The foot of the field line through a point in space. This file is included into the plain namespace (double
// and dual numbers) and into that of every instruction set (packs of floats), so it has no include guard. See
// sim/emit/footprint/foot.h.

/// A point of a ray, in km from the body's centre. `sphere_km` is the body's radius.
template <class L>
struct AirPoint {
  L x[3];
  L square;  ///< |x|^2 less the square of the body's radius, computed without cancellation
};

/// Returns the point u km along the ray from its reference point `place`, whose `square` is given and whose
/// component along the ray is `along`.
template <class L>
VEGARD_INLINE AirPoint<L> point_of_ray(const L place[3], const L direction[3], const L& square,
                                       const L& along, const L& u) {
  AirPoint<L> p;
  for (int i = 0; i < 3; ++i) p.x[i] = place[i] + u * direction[i];
  p.square = square + u * (along + along + u);
  return p;
}

template <class L>
VEGARD_INLINE L radius_km(const AirPoint<L>& p, double sphere_km) {
  return square_root(p.square + L(sphere_km * sphere_km));
}

template <class L>
VEGARD_INLINE L altitude_km(const AirPoint<L>& p, double sphere_km) {
  return p.square / (radius_km(p, sphere_km) + L(sphere_km));
}

/// The foot on the sphere of kFootAltitudeKm: its east and north components from the body's centre in the
/// axes of `p`.
template <class L>
struct PlaneFoot {
  L east_km, north_km;
  decltype(value_of(std::declval<L>()) < value_of(std::declval<L>())) is_there;
};

/// Returns the foot vertically below.
template <class L>
VEGARD_INLINE PlaneFoot<L> foot_below(const AirPoint<L>& p, double sphere_km) {
  const L scale = L(sphere_km + kFootAltitudeKm) / radius_km(p, sphere_km);
  return {p.x[0] * scale, p.x[1] * scale, value_of(L(0.0)) < value_of(p.x[2])};
}

/// Returns the foot along a direction of fall, where its line meets the sphere of feet. There is none if the
/// line misses the sphere or does not fall.
template <class L>
VEGARD_INLINE PlaneFoot<L> foot_along(const AirPoint<L>& p, const L along[3], double sphere_km) {
  const L above = p.square - L(kFootAltitudeKm * (kFootAltitudeKm + 2.0 * sphere_km));
  const L rise = p.x[0] * along[0] + p.x[1] * along[1] + p.x[2] * along[2];
  const L root2 = rise * rise - above;
  const auto falls = value_of(L(1.0)) < value_of(root2) && value_of(rise) < value_of(L(-1.0));
  const L safe_rise = select(falls, rise, L(-1.0));
  const L way = above / (square_root(select(falls, root2, L(1.0))) - safe_rise);
  const L height = p.x[2] + way * along[2];
  return {p.x[0] + way * along[0], p.x[1] + way * along[1], falls && value_of(L(0.0)) < value_of(height)};
}

/// Computes the direction of fall in a dipole field at a foot; sim/emit/aurora/beam.h does the same for a
/// beam.
template <class L>
VEGARD_INLINE void dipole_fall(const L axis[3], const PlaneFoot<L>& foot, double sphere_km, L along[3]) {
  const double radius = sphere_km + kFootAltitudeKm;
  const L level2 = foot.east_km * foot.east_km + foot.north_km * foot.north_km;
  const L height2 = L(radius * radius) - level2;
  const L height = square_root(select(value_of(L(1.0)) < value_of(height2), height2, L(1.0)));
  const L place[3] = {foot.east_km * L(1.0 / radius), foot.north_km * L(1.0 / radius),
                      height * L(1.0 / radius)};
  const L up = place[0] * axis[0] + place[1] * axis[1] + place[2] * axis[2];
  const L size = square_root(up * up * L(3.0) + L(1.0));
  const L scale = L(1.0) / select(value_of(up) < value_of(L(0.0)), L(0.0) - size, size);
  for (int i = 0; i < 3; ++i) along[i] = (axis[i] - up * place[i] * L(3.0)) * scale;
}

/// Computes the direction of fall at a foot in the field of a plane's patch (sim/light/field/field_body.h).
template <class L, class Number>
VEGARD_INLINE void patch_fall(const Number* patch, const L& per_place, const PlaneFoot<L>& foot, L along[3]) {
  constexpr double kRadius = kEarthRadiusKm + kFootAltitudeKm;
  const L level2 = foot.east_km * foot.east_km + foot.north_km * foot.north_km;
  const L height2 = L(kRadius * kRadius) - level2;
  const L place[3] = {foot.east_km, foot.north_km,
                      square_root(select(value_of(L(1.0)) < value_of(height2), height2, L(1.0)))};
  L field[3];
  field_of_patch(patch, foot.east_km * per_place, foot.north_km * per_place, field);
  fall_in_field(field, place, along);
}

/// Returns the foot along the direction of the field at the foot itself, `fall_at(foot, along)`, by three
/// iterations from the place below the point. For a dipole each iteration leaves less than three times
/// (altitude - 110 km) / (6481 km cos chi) of the error before it, where chi is the angle of the field to the
/// vertical.
template <class L, class FallAt>
VEGARD_INLINE PlaneFoot<L> foot_of_field(const AirPoint<L>& p, double sphere_km, const FallAt& fall_at) {
  PlaneFoot<L> foot = foot_below(p, sphere_km);
  const auto above_horizon = foot.is_there;
  for (int step = 0; step < 3; ++step) {
    L along[3];
    fall_at(foot, along);
    foot = foot_along(p, along, sphere_km);
  }
  foot.is_there = foot.is_there && above_horizon;
  return foot;
}

template <class L>
VEGARD_INLINE PlaneFoot<L> foot_of_dipole(const AirPoint<L>& p, const L axis[3], double sphere_km) {
  return foot_of_field(p, sphere_km, [axis, sphere_km](const PlaneFoot<L>& foot, L along[3]) {
    dipole_fall(axis, foot, sphere_km, along);
  });
}

template <class L, class Number>
VEGARD_INLINE PlaneFoot<L> foot_of_patch(const AirPoint<L>& p, const Number* patch, const L& per_place) {
  return foot_of_field(p, kEarthRadiusKm, [patch, &per_place](const PlaneFoot<L>& foot, L along[3]) {
    patch_fall(patch, per_place, foot, along);
  });
}

/// A place on the face of a cube about the body's centre (sim/emit/footprint/map/footprint_map.h).
template <class L>
struct FacePlace {
  L u, v;
  L ahead;  ///< component of the point along the face's axis; not positive behind the cube's centre
};

template <class L>
VEGARD_INLINE FacePlace<L> place_on_face(const AirPoint<L>& p, int face) {
  const int a = face / 2;
  const L ahead = face % 2 == 0 ? p.x[a] : L(0.0) - p.x[a];
  const L inverse = L(1.0) / select(value_of(L(1.0)) < value_of(ahead), ahead, L(1.0));
  return {p.x[(a + 1) % 3] * inverse, p.x[(a + 2) % 3] * inverse, ahead};
}

/// Returns the number of the face on which a direction lies. Faces are convex: if both ends of a straight
/// stretch are on a face, all of it is.
template <class L>
VEGARD_INLINE L face_number(const AirPoint<L>& p) {
  const L zero(0.0), one(1.0);
  L size[3], backwards[3];
  for (int i = 0; i < 3; ++i) {
    const auto negative = value_of(p.x[i]) < value_of(zero);
    size[i] = select(negative, zero - p.x[i], p.x[i]);
    backwards[i] = select(negative, one, zero);
  }
  const auto first = value_of(size[1]) <= value_of(size[0]) && value_of(size[2]) <= value_of(size[0]);
  const auto second = value_of(size[2]) <= value_of(size[1]);
  return select(first, backwards[0], select(second, L(2.0) + backwards[1], L(4.0) + backwards[2]));
}

/// Returns the foot of a point anywhere around the body, in the body's axes, by three iterations along the
/// direction of the field at the foot, `fall_at(unit vector of the foot, along)`. The foot is vertically
/// below if the line misses the sphere of the feet or does not fall. Only `x` of the result is set.
template <class L, class FallAt>
VEGARD_INLINE AirPoint<L> foot_around_body(const AirPoint<L>& p, double sphere_km, const FallAt& fall_at) {
  const double radius = sphere_km + kFootAltitudeKm;
  const L above = p.square - L(kFootAltitudeKm * (kFootAltitudeKm + 2.0 * sphere_km)),
          scale = L(radius) / radius_km(p, sphere_km);
  const L below[3] = {p.x[0] * scale, p.x[1] * scale, p.x[2] * scale};
  AirPoint<L> foot = p;
  for (int i = 0; i < 3; ++i) foot.x[i] = below[i];
  for (int step = 0; step < 3; ++step) {
    const L place[3] = {foot.x[0] * L(1.0 / radius), foot.x[1] * L(1.0 / radius),
                        foot.x[2] * L(1.0 / radius)};
    L along[3];
    fall_at(place, along);
    const L rise = p.x[0] * along[0] + p.x[1] * along[1] + p.x[2] * along[2];
    const L root2 = rise * rise - above;
    const auto falls = value_of(L(1.0)) < value_of(root2) && value_of(rise) < value_of(L(-1.0));
    const L safe_rise = select(falls, rise, L(-1.0));
    const L way = above / (square_root(select(falls, root2, L(1.0))) - safe_rise);
    for (int i = 0; i < 3; ++i) foot.x[i] = select(falls, p.x[i] + way * along[i], below[i]);
  }
  return foot;
}

/// foot_around_body() in a dipole field, whose axis points to its northern pole.
template <class L>
VEGARD_INLINE AirPoint<L> foot_in_dipole_around_body(const AirPoint<L>& p, const L axis[3],
                                                     double sphere_km) {
  return foot_around_body(p, sphere_km, [axis](const L place[3], L along[3]) {
    const L up = place[0] * axis[0] + place[1] * axis[1] + place[2] * axis[2];
    const L size = square_root(up * up * L(3.0) + L(1.0));
    const L scale = L(1.0) / select(value_of(up) < value_of(L(0.0)), L(0.0) - size, size);
    for (int i = 0; i < 3; ++i) along[i] = (axis[i] - up * place[i] * L(3.0)) * scale;
  });
}

/// foot_around_body() in the field of a face's patch, for a foot on this face or close to it.
template <class L, class Number>
VEGARD_INLINE AirPoint<L> foot_in_patch_around_earth(const AirPoint<L>& p, int face, const Number* patch,
                                                     const L& per_place) {
  return foot_around_body(p, kEarthRadiusKm, [&](const L place[3], L along[3]) {
    const int a = face / 2;
    const L ahead = face % 2 == 0 ? place[a] : L(0.0) - place[a], least(0.3);
    const L scale = L(1.0) / select(value_of(least) < value_of(ahead), ahead, least);
    L field[3];
    field_of_patch(patch, evened(place[(a + 1) % 3] * scale) * per_place,
                   evened(place[(a + 2) % 3] * scale) * per_place, field);
    fall_in_field(field, place, along);
  });
}
