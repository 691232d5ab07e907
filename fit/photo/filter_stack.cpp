#include "fit/photo/filter_stack.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "fit/photo/codec/picture_codes.h"
#include "sim/base/error.h"
#include "sim/base/file/number_text.h"
#include "sim/base/file/sha256.h"

namespace vegard::fit {
namespace {

constexpr std::size_t kChannels = 3;

sim::Error bad_filter(const std::string& problem) {
  return sim::Error(sim::ErrorKind::usage, problem).key("--line");
}

std::string nm_text(double wavelength_nm) { return sim::short_number(wavelength_nm, 5) + " nm"; }

/// Returns the channel of the filter, by the scene's lines.
std::size_t channel_of(double wavelength_nm, const std::vector<double>& lines_nm) {
  constexpr double kSame_nm = 1.0;
  std::string known;
  for (std::size_t i = 0; i < std::min(kChannels, lines_nm.size()); ++i) {
    if (std::abs(lines_nm[i] - wavelength_nm) <= kSame_nm) return i;
    known += (known.empty() ? "" : ", ") + nm_text(lines_nm[i]);
  }
  throw bad_filter("the scene has no line at " + nm_text(wavelength_nm) + " among its first three")
      .expected(known)
      .hint("name the line in emission.lines");
}

void check_grey(const Photo& photo, const std::string& file) {
  for (std::size_t i = 0; i < photo.linear.data.size(); i += kChannels)
    if (photo.linear.data[i] != photo.linear.data[i + 1] || photo.linear.data[i] != photo.linear.data[i + 2])
      throw sim::unreadable(file, "a picture through one filter has no colours").expected("a grey picture");
}

void take_channel(const Photo& from, std::size_t channel, Photo& to) {
  to.block_error[channel] = from.block_error[channel];
  for (std::size_t i = channel; i < to.linear.data.size(); i += kChannels) {
    to.linear.data[i] = from.linear.data[i];
    to.usable[i] = from.usable[i];
  }
}

}  // namespace

FilterFile filter_file(const std::string& text) {
  char* end = nullptr;
  const double wavelength_nm = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || *end != '=' || end[1] == '\0' ||
      !(wavelength_nm > 100.0 && wavelength_nm < 10000.0))
    throw bad_filter("'" + text + "' is no filter and file").expected("NM=FILE, 557.7=a.fits");
  return {wavelength_nm, end + 1};
}

Photo read_filters(const std::vector<FilterFile>& files, const std::vector<double>& lines_nm,
                   const Decoding& decoding, const sim::Scene* scene) {
  if (files.empty() || files.size() > kChannels)
    throw bad_filter(std::to_string(files.size()) + " filters are given").expected("one to three");
  Photo stack;
  std::string checksums;
  std::vector<PhotoPart> part_of_channel(kChannels);
  for (std::size_t i = 0; i < files.size(); ++i) {
    const FilterFile& filter = files[i];
    const std::size_t channel = lines_nm.empty() ? i : channel_of(filter.wavelength_nm, lines_nm);
    if (part_of_channel[channel].wavelength_nm > 0.0)
      throw bad_filter("two files are given for " + nm_text(filter.wavelength_nm))
          .expected("one file per filter");
    const Photo photo = read_photo(filter.file, decoding, scene);
    check_grey(photo, filter.file);
    if (i == 0) {
      stack = photo;
      stack.linear.data.assign(photo.linear.data.size(), 0.0f);
      stack.usable.assign(photo.usable.size(), 0);
      stack.block_error = {};
      stack.decoding = "one file per filter";
      stack.file_name.clear();
    } else if (photo.linear.width != stack.linear.width || photo.linear.height != stack.linear.height) {
      throw sim::unreadable(filter.file, "the picture has " + std::to_string(photo.linear.width) + " x " +
                                             std::to_string(photo.linear.height) + " pixels")
          .expected(std::to_string(stack.linear.width) + " x " + std::to_string(stack.linear.height) +
                    ", the size of " + files[0].file);
    }
    take_channel(photo, channel, stack);
    stack.bits = std::min(stack.bits, photo.bits);
    stack.step = std::max(stack.step, photo.step);
    stack.floating = stack.floating && photo.floating;
    stack.srgb = stack.srgb || photo.srgb;
    stack.decoding += (i == 0 ? ": " : "; ") + nm_text(filter.wavelength_nm) + " " + photo.decoding;
    stack.file_name += (i == 0 ? "" : ", ") + photo.file_name;
    part_of_channel[channel] = {photo.file_name, photo.sha256, filter.wavelength_nm};
  }
  for (const PhotoPart& part : part_of_channel) {
    checksums += sim::short_number(part.wavelength_nm, 5) + " " + part.sha256 + "\n";
    stack.filters.push_back(part);
  }
  stack.sha256 = sim::sha256(checksums);
  return stack;
}

}  // namespace vegard::fit
