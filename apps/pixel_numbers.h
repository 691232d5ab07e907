// Places in a picture, as words on the command line.
#pragma once

#include <string>
#include <vector>

#include "fit/photo/mask/picture_point.h"

namespace vegard::apps {

/// The numbers of "360,237,226", `count` of them. Throws Error(usage) about the option `key`.
std::vector<double> pixel_numbers(const std::string& word, std::size_t count, const std::string& key);

/// Words "x,y". Throws as above.
std::vector<fit::PicturePoint> picture_points(const std::vector<std::string>& words, const std::string& key);

}  // namespace vegard::apps
