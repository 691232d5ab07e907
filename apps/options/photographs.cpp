#include "apps/options/photographs.h"

#include <filesystem>
#include <set>
#include <utility>

#include "apps/options/photo_options.h"
#include "apps/options/standard_streams.h"
#include "fit/photo/photo.h"
#include "fit/photo/photo_defaults.h"
#include "fit/photo/photo_metadata.h"
#include "sim/base/error.h"
#include "sim/base/file/number_text.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/scene/table/photo_scene.h"

namespace vegard::apps {
namespace {

std::string beside(const std::string& scene_file, const std::string& name) {
  return (std::filesystem::path(scene_file).parent_path() / name).string();
}

fit::Averaging averaging_of(const sim::Scene& scene, PhotoPixels pixels) {
  return pixels == PhotoPixels::for_fit ? fit::averaging_for_fit(scene) : fit::Averaging();
}

fit::Photo photograph_of(const sim::Scene& scene, const sim::PhotoEntry& entry, PhotoPixels pixels) {
  const sim::Scene own = sim::scene_of_photo(scene, entry);
  const fit::Decoding decoding = entry.decoding.empty()
                                     ? decoding_of("", scene.fit.decoding, &scene)
                                     : decoding_of("", entry.decoding, nullptr, beside(scene.file, ""));
  fit::Photo photo =
      fit::read_photo(beside(scene.file, entry.file), decoding, &own, averaging_of(own, pixels));
  if (!entry.mask.empty()) fit::apply_mask(photo, beside(scene.file, entry.mask));
  return photo;
}

std::set<std::string> paths_of(const std::vector<std::string>& changes) {
  std::set<std::string> paths;
  for (const std::string& words : changes) {
    std::string path = words.substr(0, words.find('='));
    path.erase(path.find_last_not_of(' ') + 1);
    path.erase(0, path.find_first_not_of(' '));
    paths.insert(path);
  }
  return paths;
}

}  // namespace

PhotoWords with_frames_chosen(PhotoWords words) {
  if (words.at.empty()) return words;
  // Checked as words, before any file: NM=FILE.
  const std::vector<fit::FilterFile> filters = filter_files(words.filters);
  for (std::size_t i = 0; i < filters.size(); ++i) {
    std::string& word = words.filters[i];
    word.replace(word.size() - filters[i].file.size(), filters[i].file.size(),
                 picture_at(filters[i].file, words.at));
  }
  if (!words.file.empty() || filters.empty()) words.file = picture_at(words.file, words.at);
  words.at.clear();
  return words;
}

std::vector<fit::Photo> photographs_asked(const PhotoWords& words, const sim::Scene& scene,
                                          PhotoPixels pixels) {
  const auto refuse = [](const std::string& key, const std::string& problem, const std::string& hint) {
    sim::ErrorDetails details;
    details.key = key;
    details.problem = problem;
    details.hint = hint;
    throw sim::Error(sim::ErrorKind::usage, details);
  };
  if (scene.fit.photos.empty()) {
    if (!words.file.empty() && !words.filters.empty())
      refuse("--line", "a photograph is given as well", "leave out --photo");
    if (words.file.empty() && words.filters.empty())
      refuse("--photo", "no photograph is given", "name one, or several in the scene's [[fit.photo]]");
    std::vector<fit::Photo> photos;
    const fit::Decoding decoding = decoding_of(words.decoding, scene.fit.decoding, &scene);
    if (words.filters.empty()) {
      photos.push_back(fit::read_photo(words.file, decoding, &scene, averaging_of(scene, pixels)));
    } else {
      check_filters(scene);
      photos.push_back(
          fit::read_filters(filter_files(words.filters), scene.emission.lines, decoding, &scene));
    }
    if (!words.mask.empty()) fit::apply_mask(photos.back(), words.mask);
    return photos;
  }
  if (!words.filters.empty())
    refuse("--line", "the scene names its photographs itself", "leave it out, or [[fit.photo]] of the scene");
  for (const auto& [key, word] :
       {std::pair{"--photo", &words.file}, {"--mask", &words.mask}, {"--decoding", &words.decoding}})
    if (!word->empty())
      refuse(key, "the scene names its photographs itself", "leave it out, or [[fit.photo]] of the scene");
  return photographs_of(scene, pixels);
}

std::vector<fit::Photo> photographs_of(const sim::Scene& scene, PhotoPixels pixels) {
  std::vector<fit::Photo> photos;
  for (const sim::PhotoEntry& entry : scene.fit.photos) {
    try {
      photos.push_back(photograph_of(scene, entry, pixels));
    } catch (const sim::Error& error) {
      sim::ErrorDetails details = error.details();
      details.problem = "photograph '" + entry.name + "': " + details.problem;
      if (details.hint.empty() && error.kind() == sim::ErrorKind::unreadable_input)
        details.hint = "its name is relative to the scene's file";
      throw sim::Error(error.kind(), details);
    }
  }
  return photos;
}

std::vector<fit::InputFile> inputs_of(const std::string& scene_file, const std::string& scene_sha256,
                                      const std::vector<fit::Photo>& photos) {
  std::vector<fit::InputFile> inputs = {
      {"scene", std::filesystem::path(scene_file).filename().string(), scene_sha256}};
  for (const fit::Photo& photo : photos) {
    if (photo.filters.empty()) inputs.push_back({"photo", photo.file_name, photo.sha256});
    for (const fit::PhotoPart& part : photo.filters)
      if (part.wavelength_nm > 0.0)
        inputs.push_back(
            {"photo " + sim::short_number(part.wavelength_nm) + " nm", part.file_name, part.sha256});
    if (!photo.mask_name.empty()) inputs.push_back({"mask", photo.mask_name, photo.mask_sha256});
  }
  return inputs;
}

sim::PictureMetadata metadata_of(const std::string& photo) {
  sim::PictureMetadata metadata = fit::photo_metadata(photo);
  if (!metadata.width_px || !metadata.height_px) {
    const fit::Photo pixels = fit::read_photo(photo, fit::Decoding::automatic);
    metadata.width_px = pixels.linear.width;
    metadata.height_px = pixels.linear.height;
  }
  return metadata;
}

std::vector<fit::PhotoFact> take_from_photograph(sim::Scene& scene, const std::string& photo,
                                                 const std::vector<std::string>& changes) {
  const std::set<std::string> given = paths_of(changes);
  // To decode a large picture only for a size that is given already would be a waste.
  const bool size_given = scene.lines.count("camera.width") + given.count("camera.width") > 0 ||
                          scene.lines.count("camera.height") + given.count("camera.height") > 0;
  const sim::PictureMetadata metadata = size_given ? fit::photo_metadata(photo) : metadata_of(photo);
  fit::PhotoDefaults defaults = fit::with_photo_defaults(scene, metadata, given);
  sim::validate(defaults.scene);
  for (const fit::PhotoFact& fact : defaults.taken)
    say("from the photograph: %s\n", fit::fact_text(fact).c_str());
  for (const std::string& note : defaults.notes) say("note: %s\n", note.c_str());
  show_output();  // before a long fit
  scene = std::move(defaults.scene);
  return defaults.taken;
}

}  // namespace vegard::apps
