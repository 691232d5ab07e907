#include "sim/view/sky/bright_stars.h"

#include <algorithm>
#include <cassert>
#include <cctype>
#include <charconv>
#include <string_view>

#include "sim/base/data_folders.h"

namespace vegard::sim {
namespace {

std::vector<std::string> star_cells(std::string_view line) {
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',') {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

/// Reads a cell's number; 0 for an empty cell.
template <typename Number>
Number star_number(const std::string& cell) {
  Number number{};
  std::from_chars(cell.data(), cell.data() + cell.size(), number);
  return number;
}

std::vector<BrightStar> read_star_table() {
  const std::string_view text = embedded_table("bright_stars.csv");
  std::vector<BrightStar> stars;
  bool header = true;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    if (line.empty() || line.front() == '#') continue;
    if (header) {
      header = false;
      continue;
    }
    const std::vector<std::string> cells = star_cells(line);
    assert(cells.size() == 10);
    BrightStar star;
    star.hip = star_number<int>(cells[0]);
    star.hd = star_number<int>(cells[1]);
    star.designation = cells[2];
    star.name = cells[3];
    star.place.j2000 = {star_number<double>(cells[4]), star_number<double>(cells[5])};
    star.place.motion_ra_mas_per_year = star_number<double>(cells[6]);
    star.place.motion_dec_mas_per_year = star_number<double>(cells[7]);
    star.magnitude = star_number<double>(cells[8]);
    if (!cells[9].empty()) star.colour_index = star_number<double>(cells[9]);
    stars.push_back(star);
  }
  return stars;
}

void append_faint_stars(std::vector<BrightStar>& stars) {
  const std::string_view text = embedded_table("faint_stars.csv");
  const char *at = text.data() + std::min(text.find('\n') + 1, text.size()), *const end =
                                                                                 text.data() + text.size();
  const auto read = [&](auto& number) {
    at = std::min(std::from_chars(at, end, number).ptr + 1, end);  // behind the comma or the line's end
  };
  while (at < end) {
    BrightStar star;
    read(star.hip);
    read(star.place.j2000.right_ascension_deg);
    read(star.place.j2000.declination_deg);
    read(star.place.motion_ra_mas_per_year);
    read(star.place.motion_dec_mas_per_year);
    read(star.magnitude);
    stars.push_back(star);
  }
}

/// Returns the words in small letters without blanks.
std::string name_without_blanks(const std::string& words) {
  std::string out;
  for (const char c : words)
    if (!std::isspace(static_cast<unsigned char>(c)))
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

}  // namespace

std::string BrightStar::label() const {
  if (!name.empty()) return name;
  if (!designation.empty()) return designation;
  return "HIP " + std::to_string(hip);
}

const std::vector<BrightStar>& catalogue_stars() {
  static const std::vector<BrightStar> stars = read_star_table();
  return stars;
}

const std::vector<BrightStar>& bright_stars() {
  static const std::vector<BrightStar> stars = [] {
    constexpr double kFaintestBright = 4.5;
    std::vector<BrightStar> bright;
    for (const BrightStar& star : catalogue_stars())
      if (star.magnitude <= kFaintestBright) bright.push_back(star);
    return bright;
  }();
  return stars;
}

const std::vector<BrightStar>& deep_stars() {
  static const std::vector<BrightStar> stars = [] {
    std::vector<BrightStar> all = catalogue_stars();
    append_faint_stars(all);
    return all;
  }();
  return stars;
}

const BrightStar* find_bright_star(const std::string& words) {
  const std::string wanted = name_without_blanks(words);
  if (wanted.empty()) return nullptr;
  for (const BrightStar& star : catalogue_stars()) {
    if (wanted == name_without_blanks(star.name) || wanted == name_without_blanks(star.designation) ||
        wanted == "hip" + std::to_string(star.hip) ||
        (star.hd > 0 && wanted == "hd" + std::to_string(star.hd)))
      return &star;
  }
  return nullptr;
}

}  // namespace vegard::sim
