// Where the light of a point in space has its foot: one source, included into the plain namespace (double and
// dual numbers) and into that of every instruction set (packs of floats). See sim/emit/footprint/foot.h. No
// include guard.

/// A point of a ray, in km from the Earth's centre.
template <class L>
struct AirPoint {
  L x[3];
  L square;  ///< |x|^2 less the square of the Earth's radius, without the digits that a difference would lose
};

/// From a reference on the ray: u km on from the point `place`, whose `square` is given and whose part along
/// the ray is `along`.
template <class L>
VEGARD_INLINE AirPoint<L> point_of_ray(const L place[3], const L direction[3], const L& square,
                                       const L& along, const L& u) {
  AirPoint<L> p;
  for (int i = 0; i < 3; ++i) p.x[i] = place[i] + u * direction[i];
  p.square = square + u * (along + along + u);
  return p;
}

template <class L>
VEGARD_INLINE L radius_km(const AirPoint<L>& p) {
  return square_root(p.square + L(kEarthRadiusKm * kEarthRadiusKm));
}

template <class L>
VEGARD_INLINE L altitude_km(const AirPoint<L>& p) {
  return p.square / (radius_km(p) + L(kEarthRadiusKm));
}

/// The foot on the sphere of kFootAltitudeKm, as its east and north of the Earth's centre in the axes of `p`.
template <class L>
struct PlaneFoot {
  L east_km, north_km;
  decltype(value_of(std::declval<L>()) < value_of(std::declval<L>())) is_there;
};

/// Straight down.
template <class L>
VEGARD_INLINE PlaneFoot<L> foot_below(const AirPoint<L>& p) {
  const L scale = L(kEarthRadiusKm + kFootAltitudeKm) / radius_km(p);
  return {p.x[0] * scale, p.x[1] * scale, value_of(L(0.0)) < value_of(p.x[2])};
}

/// Along a direction of fall, where its line meets that sphere. There is none where the line misses the
/// sphere or does not fall.
template <class L>
VEGARD_INLINE PlaneFoot<L> foot_along(const AirPoint<L>& p, const L along[3]) {
  constexpr double kFootSquare = kFootAltitudeKm * (kFootAltitudeKm + 2.0 * kEarthRadiusKm);
  const L above = p.square - L(kFootSquare);
  const L rise = p.x[0] * along[0] + p.x[1] * along[1] + p.x[2] * along[2];
  const L root2 = rise * rise - above;
  const auto falls = value_of(L(1.0)) < value_of(root2) && value_of(rise) < value_of(L(-1.0));
  const L safe_rise = select(falls, rise, L(-1.0));
  const L way = above / (square_root(select(falls, root2, L(1.0))) - safe_rise);
  const L height = p.x[2] + way * along[2];
  return {p.x[0] + way * along[0], p.x[1] + way * along[1], falls && value_of(L(0.0)) < value_of(height)};
}

/// The direction of a dipole's fall at a foot; see sim/emit/aurora/dipole.h, which is the same for a beam.
template <class L>
VEGARD_INLINE void dipole_fall(const L axis[3], const PlaneFoot<L>& foot, L along[3]) {
  constexpr double kRadius = kEarthRadiusKm + kFootAltitudeKm;
  const L level2 = foot.east_km * foot.east_km + foot.north_km * foot.north_km;
  const L height2 = L(kRadius * kRadius) - level2;
  const L height = square_root(select(value_of(L(1.0)) < value_of(height2), height2, L(1.0)));
  const L place[3] = {foot.east_km * L(1.0 / kRadius), foot.north_km * L(1.0 / kRadius),
                      height * L(1.0 / kRadius)};
  const L up = place[0] * axis[0] + place[1] * axis[1] + place[2] * axis[2];
  const L size = square_root(up * up * L(3.0) + L(1.0));
  const L scale = L(1.0) / select(value_of(up) < value_of(L(0.0)), L(0.0) - size, size);
  for (int i = 0; i < 3; ++i) along[i] = (axis[i] - up * place[i] * L(3.0)) * scale;
}

/// Along the direction that a dipole has at the foot itself: three steps from the place below the point. Each
/// leaves less than three times (altitude - 110 km) / (6481 km cos chi) of the error before it, where chi is
/// the angle of the field to the vertical.
template <class L>
VEGARD_INLINE PlaneFoot<L> foot_of_dipole(const AirPoint<L>& p, const L axis[3]) {
  PlaneFoot<L> foot = foot_below(p);
  const auto above_horizon = foot.is_there;
  for (int step = 0; step < 3; ++step) {
    L along[3];
    dipole_fall(axis, foot, along);
    foot = foot_along(p, along);
  }
  foot.is_there = foot.is_there && above_horizon;
  return foot;
}

/// A place on the face of a cube about the Earth's centre (sim/emit/footprint/map/footprint_map.h).
template <class L>
struct FacePlace {
  L u, v;
  L ahead;  ///< the part of the point along the face's axis; not positive behind the cube's centre
};

template <class L>
VEGARD_INLINE FacePlace<L> place_on_face(const AirPoint<L>& p, int face) {
  const int a = face / 2;
  const L ahead = face % 2 == 0 ? p.x[a] : L(0.0) - p.x[a];
  const L inverse = L(1.0) / select(value_of(L(1.0)) < value_of(ahead), ahead, L(1.0));
  return {p.x[(a + 1) % 3] * inverse, p.x[(a + 2) % 3] * inverse, ahead};
}

/// The number of the face that a direction lies on. Faces are convex: if both ends of a straight stretch are
/// on one, so is all of it.
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
