#include "apps/options/photographs.h"

#include <set>
#include <utility>

#include "apps/options/photo_options.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "fit/measurement/sky_light.h"
#include "fit/photo/photo.h"
#include "sim/base/error.h"
#include "sim/base/text.h"

namespace vegard::apps {
namespace {

std::set<std::string> paths_of(const std::vector<std::string>& changes) {
  std::set<std::string> paths;
  for (const std::string& words : changes)
    paths.emplace(sim::trimmed(std::string_view(words).substr(0, words.find('=')), " "));
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
                                          fit::PhotoPixels pixels) {
  if (scene.fit.photos.empty()) {
    if (!words.file.empty() && !words.filters.empty())
      throw usage_error("--line", "a photograph is given as well", "", "leave out --photo");
    if (words.file.empty() && words.filters.empty())
      throw usage_error("--photo", "no photograph is given", "",
                        "name one, or several in the scene's [[fit.photo]]");
    std::vector<fit::Photo> photos;
    if (words.filters.empty()) {
      photos.push_back(fit::photograph_for(scene, words.file, words.mask, words.decoding, pixels));
      return photos;
    }
    check_filters(scene);
    photos.push_back(fit::read_filters(filter_files(words.filters), scene.emission.lines,
                                       fit::decoding_for(scene, words.decoding), &scene));
    if (!words.mask.empty()) fit::apply_mask(photos.back(), words.mask);
    return photos;
  }
  if (!words.filters.empty())
    throw usage_error("--line", "the scene names its photographs itself", "",
                      "leave it out, or [[fit.photo]] of the scene");
  for (const auto& [key, word] :
       {std::pair{"--photo", &words.file}, {"--mask", &words.mask}, {"--decoding", &words.decoding}})
    if (!word->empty())
      throw usage_error(key, "the scene names its photographs itself", "",
                        "leave it out, or [[fit.photo]] of the scene");
  return fit::photographs_of(scene, pixels);
}

std::vector<fit::PhotoFact> take_from_photograph(sim::Scene& scene, const std::string& photo,
                                                 const std::vector<std::string>& changes) {
  return fit::take_from_photograph(scene, photo, paths_of(changes), said());
}

}  // namespace vegard::apps
