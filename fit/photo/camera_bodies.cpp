#include "fit/photo/camera_bodies.h"

#include <algorithm>
#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <system_error>
#include <vector>

#include "sim/base/file/input_file.h"

namespace vegard::fit {
namespace {

using boost::property_tree::ptree;

/// Small letters, one blank between words, none at the ends.
std::string plain_words(const std::string& text) {
  std::istringstream in(text);
  std::string word, all;
  while (in >> word) all += (all.empty() ? "" : " ") + word;
  std::transform(all.begin(), all.end(), all.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return all;
}

std::string first_word(const std::string& words) { return words.substr(0, words.find(' ')); }

/// Returns the files named *.xml, in the order of their names.
std::vector<std::string> xml_files(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code trouble;
  for (std::filesystem::directory_iterator at(folder, trouble), end; !trouble && at != end;
       at.increment(trouble))
    if (at->path().extension() == ".xml") files.push_back(at->path().string());
  std::sort(files.begin(), files.end());
  return files;
}

/// The element's text without an attribute lang, which has the names as people say them.
std::string text_of(const ptree& camera, const char* name) {
  for (const auto& [key, child] : camera)
    if (key == name && !child.get_optional<std::string>("<xmlattr>.lang")) return child.data();
  return {};
}

std::optional<CameraBody> body_in(const ptree& database, const std::string& make, const std::string& model) {
  for (const auto& [key, camera] : database) {
    if (key != "camera" || plain_words(text_of(camera, "model")) != model) continue;
    CameraBody body{text_of(camera, "maker"), text_of(camera, "model"), 0.0};
    if (first_word(plain_words(body.maker)) != first_word(make)) continue;
    body.crop_factor = camera.get<double>("cropfactor", 0.0);
    if (body.crop_factor >= 0.1 && body.crop_factor <= 20.0) return body;
  }
  return std::nullopt;
}

}  // namespace

std::string lensfun_folder() {
  if (const char* given = std::getenv("VEGARD_LENSFUN")) return given;
  std::error_code trouble;
  for (const char* folder : {"/usr/local/share/lensfun/version_2", "/usr/local/share/lensfun/version_1",
                             "/usr/share/lensfun/version_2", "/usr/share/lensfun/version_1"})
    if (std::filesystem::is_directory(folder, trouble)) return folder;
  return {};
}

std::optional<CameraBody> find_camera_body(const std::string& folder, const std::string& make,
                                           const std::string& model) {
  const std::string maker_words = plain_words(make), model_words = plain_words(model);
  if (folder.empty() || model_words.empty()) return std::nullopt;
  for (const std::string& file : xml_files(folder)) {
    std::istringstream in(sim::read_input(file).bytes);
    ptree document;
    try {
      boost::property_tree::read_xml(in, document);
    } catch (const boost::property_tree::xml_parser_error&) {
      continue;
    }
    const auto database = document.get_child_optional("lensdatabase");
    if (!database) continue;
    if (const auto body = body_in(*database, maker_words, model_words)) return body;
  }
  return std::nullopt;
}

}  // namespace vegard::fit
