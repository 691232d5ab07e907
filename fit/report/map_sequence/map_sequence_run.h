// The directory of a sequence of maps: map_sequence.json, precipitation.nc with a time axis, tracks.csv,
// frames.csv, report.html and, where a film can be made, sequence.mp4 beside it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/map/precipitation_planes.h"
#include "fit/map/sequence/curtain_tracks.h"
#include "fit/map/sequence/map_sequence.h"
#include "fit/photo/pointing/joint/still_camera.h"

namespace vegard::fit {

/// One frame's row.
struct MappedFrame {
  std::size_t number = 0;  ///< among MapFrames
  std::string name;
  double time_s = 0.0;
  double chi2_per_value = 0.0;
  std::size_t curtains = 0;
  WithError power_mw;        ///< of all electrons with their lower border in view, MW
  WithError energy_kev;      ///< their mean E0, by energy flux
  bool is_good = false;      ///< whether every verdict on the map is
  std::string verdict_line;  ///< fit/map/curtains/map_verdicts.h
};

/// Planes of one frame, as PrecipitationPlanes' cells; velocities NaN where nothing constrains them, or where
/// there is no light.
struct FramePlanes {
  std::vector<float> energy_flux_mw_m2, energy_kev, relative_flux_error, ln_energy_error;
  std::vector<float> east_km_s, north_km_s, east_error_km_s, north_error_km_s;
};

struct MapSequenceRunFacts {
  std::string command;
  std::vector<InputFile> inputs;
  MapSequenceFacts sequence;
  std::optional<CameraWatch> camera;  ///< what the stars say of it; none: it was not asked
};

/// Collects the frames, and writes them.
class MapSequenceRun {
 public:
  /// Of the frames in MapFrames. `utc`: when their clock was at 0, as in site.time_utc; empty: unknown.
  MapSequenceRun(std::vector<std::string> names, std::vector<double> time_s, std::string utc)
      : names_(std::move(names)), time_s_(std::move(time_s)), utc_(std::move(utc)) {}

  void add(const MapOfFrame& frame);

  const std::vector<MappedFrame>& frames() const { return frames_; }
  std::vector<CurtainTrack> tracks() const { return tracker_.tracks(); }

  /// Makes a film of the pictures (names of PNG files) as the file `movie`; false if it could not.
  using Film = std::function<bool(const std::vector<std::string>& pictures, const std::string& movie)>;
  /// Writes the directory, completely or not at all. Throws as write_map_run() does.
  void write(const std::string& directory, bool overwrite, const MapSequenceRunFacts& facts,
             const Film& film) const;

  // What is written; the same sequence gives the same bytes.
  std::string json(const MapSequenceRunFacts& facts) const;
  std::string tracks_csv() const;
  std::string frames_csv() const;
  std::string page(const MapSequenceRunFacts& facts, bool has_film) const;
  void write_netcdf(const std::string& file, const MapSequenceRunFacts& facts) const;

 private:
  std::vector<std::string> names_;
  std::vector<double> time_s_;
  std::string utc_;
  CurtainTracker tracker_;
  std::vector<MappedFrame> frames_;
  std::vector<FramePlanes> planes_;
  PrecipitationPlanes places_;  ///< without values
  std::vector<std::string> png_;
  bool is_absolute_ = true;
  double shown_flux_mw_m2_ = 0.0;  ///< of the first frame, for the film's colours
  std::string last_picture_svg_;
};

/// Throws as MapSequenceRun::write() would, without writing.
void check_map_sequence_directory(const std::string& directory, bool overwrite);

}  // namespace vegard::fit
