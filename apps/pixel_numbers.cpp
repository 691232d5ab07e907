#include "apps/pixel_numbers.h"

#include <charconv>
#include <cmath>

#include "apps/usage_error.h"

namespace vegard::apps {

std::vector<double> pixel_numbers(const std::string& word, std::size_t count, const std::string& key) {
  std::vector<double> numbers;
  const char* at = word.data();
  const char* const end = word.data() + word.size();
  bool readable = true, more = true;
  while (readable && more) {
    double number = 0.0;
    const auto [stop, error] = std::from_chars(at, end, number);
    readable = error == std::errc{} && std::isfinite(number);
    more = readable && stop != end && *stop == ',';
    at = more ? stop + 1 : stop;
    numbers.push_back(number);
  }
  if (!readable || at != end || numbers.size() != count)
    throw usage_error(key, "'" + word + "' cannot be read",
                      std::to_string(count) + " numbers in pixels with commas between them");
  return numbers;
}

std::vector<fit::PicturePoint> picture_points(const std::vector<std::string>& words, const std::string& key) {
  std::vector<fit::PicturePoint> points;
  for (const std::string& word : words) {
    const std::vector<double> numbers = pixel_numbers(word, 2, key);
    points.push_back({numbers[0], numbers[1]});
  }
  return points;
}

}  // namespace vegard::apps
