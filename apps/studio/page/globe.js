// The ground about a place: the azimuthal equidistant projection of the sphere, which the maps of reports have too
// (fit/report/plot/earth_map.h). Places are [latitude, longitude] in degrees, points of the ground [east, north] in km.
const kEarth_km = 6371, kFeet_km = 110, kDegree = Math.PI / 180;

export function ground_about([latitude, longitude]) {
  const sine = Math.sin(latitude * kDegree), cosine = Math.cos(latitude * kDegree);
  return {
    ground_of([lat, lon]) {
      const s = Math.sin(lat * kDegree), c = Math.cos(lat * kDegree), turn = (lon - longitude) * kDegree;
      const east = c * Math.sin(turn), north = cosine * s - sine * c * Math.cos(turn), up = sine * s + cosine * c * Math.cos(turn);
      const level = Math.hypot(east, north), km = level > 0 ? kEarth_km * Math.atan2(level, up) / level : 0;
      return [km * east, km * north];
    },
    place_of([east, north]) {
      const km = Math.hypot(east, north), angle = km / kEarth_km, scale = km > 0 ? Math.sin(angle) / km : 0;
      const up = Math.cos(angle), [e, n] = [scale * east, scale * north];
      const lat = Math.asin(Math.min(1, Math.max(-1, sine * up + cosine * n)));
      const lon = longitude + Math.atan2(e, cosine * up - sine * n) / kDegree;
      return [lat / kDegree, lon - 360 * Math.round(lon / 360)];
    },
  };
}

/// Below a foot at 110 km altitude, which is given in the tangent plane of the projection's place.
export function ground_of_foot([east, north]) {
  const km = Math.hypot(east, north), scale = km > 0 ? kEarth_km * Math.asin(Math.min(1, km / (kEarth_km + kFeet_km))) / km : 1;
  return [scale * east, scale * north];
}

export const place_words = ([latitude, longitude]) =>
  `${Math.abs(latitude).toFixed(2)}° ${latitude < 0 ? "S" : "N"}, ${Math.abs(longitude).toFixed(2)}° ${longitude < 0 ? "W" : "E"}`;
