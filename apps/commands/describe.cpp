#include "apps/commands/commands.h"

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/photo_options.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/output/photo_description.h"
#include "fit/photo/frames/frame_file.h"
#include "fit/photo/frames/frame_name.h"
#include "fit/photo/light_declarations.h"
#include "fit/photo/photo_facts.h"
#include "fit/photo/pointing/exchange/aida_camera.h"
#include "fit/photo/pointing/exchange/sip_wcs.h"
#include "fit/photo/pointing/exchange/star_files.h"
#include "fit/photo/scene_photos.h"
#include "fit/photo/sky_map_file.h"
#include "sim/base/array/array_format.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/picture/fits_io.h"
#include "sim/base/shown_text.h"

namespace vegard::apps {
namespace {

std::string solution_text(const fit::SipWcs& wcs) {
  const double scale = std::sqrt(std::abs(wcs.degrees_per_px.determinant()));
  constexpr double kSecondsPerDegree = 3600.0;
  std::string text = fmt::format(
      "  a tangent plane on the sky (Astrometry.net's .wcs)\n  reference    right ascension {:.4f}, "
      "declination {:.4f} deg, J2000, at ({:.2f}, {:.2f}) px\n  scale        {:.2f} seconds of arc a pixel "
      "there\n",
      wcs.reference.right_ascension_deg, wcs.reference.declination_deg, wcs.reference_px.x() - 0.5,
      wcs.reference_px.y() - 0.5, scale * kSecondsPerDegree);
  if (wcs.width_px > 0) text += fmt::format("  size         {} x {} pixels\n", wcs.width_px, wcs.height_px);
  if (wcs.a.order > 0) text += fmt::format("  distortion   SIP of order {}\n", wcs.a.order);
  text += wcs.degrees_per_px.determinant() > 0.0 ? "  the sky is mirrored, rows counted from the top\n" : "";
  return text + "  vegard calibrate --wcs makes a camera of it\n";
}

std::string stars_text(std::string_view bytes, const std::string& path) {
  if (fit::is_star_list(bytes, path)) {
    const fit::StarPoints list = fit::read_star_list(bytes, path);
    std::string text = fmt::format("  {} points of light (Astrometry.net's .axy)\n", list.points.size());
    if (list.frame.known)
      text += fmt::format("  in {} x {} pixels\n", list.frame.width_px, list.frame.height_px);
    return text + "  vegard calibrate with --camera recognises stars among them\n";
  }
  const sim::FitsTable table = sim::read_fits_table(bytes, path);
  std::string names;
  for (const auto& [name, values] : table.columns) names += (names.empty() ? "" : ", ") + name;
  const std::size_t rows = table.columns.empty() ? 0 : table.columns.begin()->second.size();
  std::string text = fmt::format("  a FITS table of {} rows: {}\n", rows, sim::shortened_text(names));
  if (table.columns.count("field_x") != 0)
    text += "  stars that were recognised (Astrometry.net's .corr): vegard calibrate takes them\n";
  return text;
}

std::string aida_text(const std::vector<fit::AidaCamera>& cameras) {
  constexpr std::size_t kMaxShown = 20;
  std::string text =
      fmt::format("  {} camera{} of AIDA_tools\n", cameras.size(), cameras.size() == 1 ? "" : "s");
  for (std::size_t i = 0; i < cameras.size() && i < kMaxShown; ++i) {
    const fit::AidaCamera& c = cameras[i];
    text += fmt::format(
        "  line {}: station {:g}, pointed to azimuth {:g}, zenith distance {:g} deg, lens {}, f {:.4f} "
        "{:.4f} of the picture's sides\n",
        c.line, c.station, c.azimuth_deg, c.zenith_deg, c.model, c.numbers[0], c.numbers[1]);
  }
  if (cameras.size() > kMaxShown) text += "  ...\n";
  return text + "  vegard calibrate --acc makes a camera of it\n";
}

std::string word_of(const sim::ArrayWords& words, const std::string& key) {
  for (const auto& [found, value] : words)
    if (found == key) return value;
  return {};
}

std::string netcdf_text(const sim::ArrayFile& file, const sim::ArrayWords& words) {
  std::string text =
      "  netCDF by the conventions " + sim::shortened_text(word_of(words, "Conventions")) + "\n";
  for (const char* key : {"title", "source", "verdict_line"})
    if (const std::string value = word_of(words, key); !value.empty())
      text += fmt::format("  {:<12} {}\n", key, sim::shortened_text(value));
  text += "  variables:\n";
  for (const sim::StoredArray& array : file.arrays()) {
    std::string sizes;
    for (const std::uint64_t size : array.dims) sizes += (sizes.empty() ? "" : " x ") + std::to_string(size);
    const std::string units = word_of(array.words, "units");
    text += fmt::format("    {:<36} {:<14} {:<10} {}\n", sim::shown_text(array.name), sizes,
                        units.empty() ? "-" : sim::shortened_text(units),
                        sim::shortened_text(word_of(array.words, "long_name")));
  }
  return text;
}

std::optional<std::string> fits_text(const std::string& path) {
  const std::string bytes = sim::input_bytes(path, "a FITS file", sim::kMaxPictureBytes);
  const sim::FitsKeywords keywords = sim::read_fits_header(bytes, path);
  const auto axes = keywords.find("NAXIS");
  if (axes == keywords.end() || axes->second != "0") return std::nullopt;  // an image
  if (keywords.count("CTYPE1") != 0) return solution_text(fit::read_sip_wcs(bytes, path));
  const auto is_table = [&] { return bytes.find("XTENSION= 'BINTABLE'") != std::string::npos; };
  if (is_table() && keywords.count("ZIMAGE") == 0 && bytes.find("ZIMAGE") == std::string::npos)
    return stars_text(bytes, path);
  return std::nullopt;
}

/// Describes a solution of Astrometry.net (`.wcs`), its lists of stars (`.axy`, `.corr`), a camera of
/// AIDA_tools (`.acc`, by the name's ending) or a netCDF file by the CF conventions; none for any other file.
/// Throws sim::Error(unreadable_input) if such a file is damaged.
std::optional<std::string> other_file_text(const std::string& path) {
  std::optional<std::string> text;
  if (std::filesystem::path(path).extension() == ".acc") {
    text = aida_text(fit::read_aida_cameras(sim::input_bytes(path, "a camera of AIDA_tools"), path));
  } else if (constexpr std::string_view kFits = "SIMPLE  =";
             sim::read_beginning(path, kFits.size()).bytes == kFits) {
    text = fits_text(path);
  } else if (const sim::ArrayFormat* const format = sim::array_format_of(path);
             format != nullptr && format->open == sim::open_hdf5) {
    const std::unique_ptr<sim::ArrayFile> file = sim::open_array_file(path);
    const auto words = file->words().find("");
    if (words != file->words().end() && word_of(words->second, "Conventions").compare(0, 3, "CF-") == 0)
      text = netcdf_text(*file, words->second);
  }
  if (!text) return std::nullopt;
  return sim::shown_text(file_name_of(path)) + ":\n" + *text;
}

struct DescribeRequest {
  std::string photo, at, output;
  bool overwrite = false;
};

/// Nothing for a file without frames. One that has maps of directions and no images that can be distinguished
/// has none either.
std::optional<fit::FrameIndex> frames_of_photo(const std::string& photo) {
  if (fit::frame_name(photo).is_chosen() || !fit::is_frame_file(photo)) return std::nullopt;
  try {
    return fit::frame_index(photo);
  } catch (const sim::Error&) {
    if (fit::has_sky_map(photo)) return std::nullopt;
    throw;
  }
}

int run_describe(const DescribeRequest& options) {
  if (same_file(options.photo, options.output))
    throw same_file_error("--output", options.output, "the picture");
  const std::string name = file_name_of(options.photo);
  if (options.output.empty() && !fit::frame_name(options.photo).is_chosen())
    if (const std::optional<std::string> other = other_file_text(options.photo)) {
      json_answer() = {{"file", name}, {"words", *other}};
      say_result(*other);
      return good;
    }
  const std::optional<fit::FrameIndex> frames = frames_of_photo(options.photo);
  if (!frames && fit::has_sky_map(options.photo)) {
    if (!options.output.empty())
      throw usage_error("--output", "a skymap is no picture to make a scene of", "no -o with a skymap",
                        "vegard calibrate --skymap makes a camera of it");
    const fit::SkyMapFile map = fit::read_sky_map(options.photo);
    answer_with(sky_map_description_json(name, map));
    say_result(sky_map_description_text(name, map));
    return good;
  }
  if (frames) {
    const fit::FrameIndex& index = *frames;
    if (index.frames.size() > 1) {
      // A scene is of one moment.
      if (!options.output.empty()) throw fit::no_frame_chosen(index.frames, options.photo);
      // A film's frames are of one kind, whose light is assumed where the film does not declare it.
      const bool is_film = index.frames.front().stream.seconds.has_value();
      const std::vector<std::string> declared =
          is_film ? fit::light_declarations(fit::name_of_frame(options.photo, 0))
                  : std::vector<std::string>();
      answer_with(frames_description_json(name, index, declared));
      say_result(frames_description_text(name, index, declared));
      return good;
    }
  }
  const sim::PictureMetadata metadata = fit::metadata_with_size(options.photo);
  if (!options.output.empty()) {
    sim::WholeFile file(options.output, options.overwrite);
    file.write(start_scene(name, fit::photo_facts(metadata)));
    file.commit();
  }
  const std::vector<std::string> declared = fit::light_declarations(options.photo);
  const std::string light = declared.empty() ? fit::assumed_light(options.photo) : "";
  answer_with(description_json(name, metadata, declared, light));
  say_result(description_text(name, metadata, declared, light));
  if (!options.output.empty()) json_answer()["outputs"] = json_names({options.output});
  if (!options.output.empty()) say("%s\n", options.output.c_str());
  return good;
}

}  // namespace

void add_describe_command(Program& program) {
  const auto options = std::make_shared<DescribeRequest>();
  const Command command = program.add(
      "describe", "Print a picture's metadata (place, time, lens, exposure), and write a scene of it");
  command
      .option("PHOTO", options->photo,
              "A picture, a file of frames, a skymap, netCDF, a solution or star list of Astrometry.net, or "
              "a camera of AIDA_tools")
      .required();
  add_at_option(command, options->at);
  command.option("-o,--output", options->output, "Write a scene to begin with").type_name("SCENE.toml");
  command.flag("--overwrite", options->overwrite, "Replace an output that exists");
  command.runs([options] {
    options->photo = picture_at(options->photo, options->at);
    return run_describe(*options);
  });
}

}  // namespace vegard::apps
