#include "fit/report/table/profile_csv.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

namespace vegard::fit::profile_csv_test {
namespace {

Photo small_photo() {
  Photo photo;
  photo.linear = sim::Image(4, 3, {"R", "G", "B"});
  for (std::size_t i = 0; i < photo.linear.data.size(); ++i) photo.linear.data[i] = 0.01f * (1 + i * i % 17);
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.usable[photo.linear.index(0, 1, 2)] = photo.usable[photo.linear.index(1, 1, 2)] = 0;
  photo.decoding = "sRGB (8-bit JPEG, assumed)";
  photo.file_name = "sky\n.jpg";
  photo.sha256 = "ab12";
  return photo;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line)
    if (c == ',')
      cells.emplace_back();
    else
      cells.back() += c;
  return cells;
}

TEST(ProfileCsv, ReadsBackAsTheSameNumbers) {
  const Photo photo = small_photo();
  const Profile profile = extract_profile(photo, {0, 1, 4, 2}, 2);
  const auto elevation = [](double x_px, double y_px) { return 40.0 - x_px / 3.0 - 2.0 * y_px; };
  std::vector<std::string> names;
  int band = 0, row = 0, lines = 0;
  for (const std::string& line : lines_of(profile_csv(photo, profile, elevation))) {
    if (line[0] == '#') continue;
    const std::vector<std::string> cells = cells_of(line);
    if (names.empty()) {
      names = cells;
      ASSERT_EQ(names.size(), 16u);
      continue;
    }
    ASSERT_EQ(cells.size(), names.size());
    EXPECT_EQ(cells[0], std::to_string(band));
    EXPECT_EQ(cells[1], std::to_string(1 + row));
    EXPECT_EQ(std::stod(cells[2]), elevation(band == 0 ? 1.0 : 3.0, 1.5 + row));
    for (int c = 0; c < 3; ++c) {
      const std::size_t i = profile.index(band, row, c);
      EXPECT_EQ(cells[9 + c], std::to_string(profile.count[i]));
      if (profile.count[i] == 0) {
        EXPECT_EQ(cells[3 + c], "");
        EXPECT_EQ(cells[6 + c], "");
        EXPECT_EQ(cells[12], "") << "a chromaticity without its third channel";
      } else {
        EXPECT_EQ(std::stod(cells[3 + c]), profile.mean[i]);
        EXPECT_EQ(std::stod(cells[6 + c]), profile.standard_error[i]);
      }
    }
    ++lines;
    if (++row == 2) row = 0, ++band;
  }
  EXPECT_EQ(lines, 4);
}

TEST(ProfileCsv, SaysWhatItIsMadeFrom) {
  Photo photo = small_photo();
  photo.mask_name = "trees.png";
  photo.mask_sha256 = "cd34";
  const std::string text = profile_csv(photo, extract_profile(photo, {0, 1, 4, 2}, 2));
  for (const char* line :
       {"# photograph: sky .jpg\n", "# sha256: ab12\n", "# decoding: sRGB (8-bit JPEG, assumed)\n",
        "# size_px: 4 x 3\n", "# roi_px: [0, 1, 4, 2]\n", "# bands: 2\n", "# band_edges_px: [0, 2, 4]\n",
        "# mask: trees.png\n", "# mask_sha256: cd34\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line;
  const std::vector<std::string> lines = lines_of(text);
  EXPECT_EQ(cells_of(lines.back())[2], "") << "an elevation without a camera";
}

}  // namespace
}  // namespace vegard::fit::profile_csv_test
