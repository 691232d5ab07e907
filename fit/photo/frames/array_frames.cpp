#include "fit/photo/frames/array_frames.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "fit/photo/codec/pnm_header.h"
#include "sim/base/error.h"
#include "sim/base/leap_seconds.h"
#include "sim/base/picture/fits_io.h"
#include "sim/base/picture/pixel_limit.h"
#include "sim/base/text.h"
#include "sim/base/utc_time.h"

namespace vegard::fit {
namespace {

using sim::ArrayKind;
using sim::StoredArray;

constexpr std::uint64_t kThreeColours = 3;

/// True if an array may hold images.
bool may_be_images(const StoredArray& array) {
  const std::size_t dims = array.dims.size();
  if (array.kind == ArrayKind::text || array.clock != sim::ArrayClock::none || dims < 2 || dims > 4)
    return false;
  return std::count_if(array.dims.begin(), array.dims.end(), [](std::uint64_t n) { return n > 1; }) >= 2;
}

/// Name and number of "frame12"; -1 without a number.
std::pair<std::string, int> numbered(const std::string& name) {
  const std::size_t end = name.find_last_not_of("0123456789") + 1;
  constexpr std::size_t kMaxDigits = 9;
  if (end == name.size() || name.size() - end > kMaxDigits) return {name, -1};
  return {name.substr(0, end), std::stoi(name.substr(end))};
}

/// "'a' (128 x 128), 'b' ..." of all arrays that may hold images.
std::string image_names(const sim::ArrayFile& file) {
  constexpr int kMaxShown = 12;
  std::string text;
  int shown = 0;
  for (const StoredArray& array : file.arrays()) {
    if (!may_be_images(array)) continue;
    if (++shown > kMaxShown) return text + " ...";
    std::string sizes;
    for (const std::uint64_t n : array.dims) sizes += (sizes.empty() ? "" : " x ") + std::to_string(n);
    text += (text.empty() ? "'" : ", '") + array.name + "' (" + sizes + ")";
  }
  return text;
}

/// The array that is called so, or whose name ends so behind a '/'.
std::size_t array_called(const sim::ArrayFile& file, const std::string& wanted) {
  const std::vector<StoredArray>& arrays = file.arrays();
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    if (!may_be_images(arrays[i])) continue;
    if (arrays[i].name == wanted) return i;
    if (sim::ends_with(arrays[i].name, "/" + wanted)) found.push_back(i);
  }
  if (found.size() == 1) return found.front();
  throw sim::Error(
      sim::ErrorKind::usage,
      (found.empty() ? "there is no array '" : "there are several arrays '") + wanted + "' in it")
      .file(file.name())
      .expected("FILE#NAME, NAME one of " + image_names(file));
}

/// The one that imagers' own files name, else the largest; of several as large, if they are numbered, all.
std::vector<std::size_t> images_of(const sim::ArrayFile& file, const std::string& wanted) {
  const std::vector<StoredArray>& arrays = file.arrays();
  if (!wanted.empty()) return {array_called(file, wanted)};
  std::vector<std::size_t> largest;
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    if (!may_be_images(arrays[i])) continue;
    if (arrays[i].name == "data/images") return {i};
    if (!largest.empty() && arrays[i].count() < arrays[largest[0]].count()) continue;
    if (!largest.empty() && arrays[i].count() > arrays[largest[0]].count()) largest.clear();
    largest.push_back(i);
  }
  if (largest.empty())
    throw sim::unreadable(file.name(), std::string("there are no images in this ") + file.format() + " file")
        .expected("an array of two to four dimensions");
  if (largest.size() == 1) return largest;
  const StoredArray& first = arrays[largest[0]];
  const auto is_like_first = [&](std::size_t i) {
    const auto [name, number] = numbered(arrays[i].name);
    return number >= 0 && name == numbered(first.name).first && arrays[i].dims == first.dims &&
           arrays[i].kind == first.kind;
  };
  if (!std::all_of(largest.begin(), largest.end(), is_like_first))
    throw sim::unreadable(file.name(), "which of its arrays is the images is not known: '" + first.name +
                                           "', '" + arrays[largest[1]].name + "' are as large")
        .expected("its name and which, FILE#NAME; there are " + image_names(file))
        .hint(
            "without a name it is one that is larger than all others, or frames that are told apart by a "
            "number "
            "behind their name");
  std::sort(largest.begin(), largest.end(), [&](std::size_t a, std::size_t b) {
    return numbered(arrays[a].name).second < numbered(arrays[b].name).second;
  });
  return largest;
}

/// Axes as MATLAB or a reader of HDF5 in Python would count them: rows before columns.
struct Axes {
  int frame = -1, row = 0, column = 1, channel = -1;
};

Axes axes_of_images(const std::vector<std::uint64_t>& dims, const sim::ArrayFile& file, std::size_t images) {
  if (dims.size() == 2) return {};
  const auto tells_times = [&](std::uint64_t frames) { return has_times(file, images, frames); };
  if (dims.size() == 3) {
    const Axes last{2, 0, 1, -1}, first{0, 1, 2, -1}, colours{-1, 0, 1, 2};
    if (tells_times(dims[0])) return first;
    if (tells_times(dims[2])) return last;
    if (dims[2] == kThreeColours) return colours;
    return dims[0] < dims[2] ? first : last;
  }
  const Axes behind{3, 0, 1, 2}, before{0, 1, 2, 3};
  const bool may_be_behind = dims[2] == kThreeColours, may_be_before = dims[3] == kThreeColours;
  if (may_be_behind && may_be_before) return tells_times(dims[0]) && !tells_times(dims[3]) ? before : behind;
  if (may_be_behind) return behind;
  if (may_be_before) return before;
  throw sim::unreadable(file.name(), "'" + file.arrays()[images].name +
                                         "' has four dimensions, and none of them is of "
                                         "three colours where it could be")
      .expected("height, width, 3, frames, or frames, height, width, 3");
}

class ArrayFrames : public FrameStore {
 public:
  ArrayFrames(std::unique_ptr<sim::ArrayFile> file, const std::string& wanted)
      : file_(std::move(file)),
        stack_(find_images(*file_, wanted)),
        times_(array_times(*file_, stack_.arrays[0], stack_.frames)) {
    const StoredArray& array = images(0);
    for (const char* group : {"", "metadata", "metadata/file"}) add_words(group, file_words_);
    file_words_.insert(file_words_.end(), array.words.begin(), array.words.end());
  }

  std::size_t size() const override { return stack_.frames; }
  std::string word_kind() const override { return std::string(file_->format()) + " word"; }

  StoredFrame frame(std::size_t number) override {
    StoredFrame frame;
    frame.width_px = stack_.width_px;
    frame.height_px = stack_.height_px;
    frame.channels = stack_.channels;
    if (number == 0) frame.words = file_words_;
    add_words("metadata/frame/frame" + std::to_string(number), frame.words);
    if (number < times_.size()) frame.time = times_[number];
    return frame;
  }

  std::string picture(std::size_t number) override {
    const StoredArray& array = images(number);
    std::vector<std::uint64_t> start(array.dims.size(), 0), count = array.dims;
    if (stack_.frame_axis >= 0) {
      start[stack_.frame_axis] = number;
      count[stack_.frame_axis] = 1;
    }
    const std::string block = file_->read(array, start, count);
    // From the file's order of dimensions to rows of pixels of colours.
    std::vector<std::size_t> stride(count.size(), 1);
    for (std::size_t d = count.size() - 1; d > 0; --d)
      stride[d - 1] = stride[d] * static_cast<std::size_t>(count[d]);
    const std::size_t row = stride[stack_.row_axis], column = stride[stack_.column_axis];
    const std::size_t channel = stack_.channel_axis >= 0 ? stride[stack_.channel_axis] : 0;
    const auto place = [&](long long y, long long x, int c) {
      return static_cast<std::size_t>(y) * row + static_cast<std::size_t>(x) * column + c * channel;
    };
    if (array.kind == ArrayKind::u8) return pnm<std::uint8_t>(block, place);
    if (array.kind == ArrayKind::u16) return pnm<std::uint16_t>(block, place);
    return fits(block, array.kind, place);
  }

 private:
  const StoredArray& images(std::size_t number) const {
    return file_->arrays()[stack_.arrays.size() > 1 ? stack_.arrays[number] : stack_.arrays[0]];
  }

  void add_words(const std::string& group, ImagerWords& words) const {
    const auto found = file_->words().find(group);
    if (found != file_->words().end()) words.insert(words.end(), found->second.begin(), found->second.end());
  }

  template <typename Number, typename Place>
  std::string pnm(const std::string& block, const Place& place) const {
    std::string bytes = std::string(stack_.channels == 1 ? "P5\n" : "P6\n") +
                        std::string(stack_.channels == 3 && sizeof(Number) > 1 ? kPnmOfCounts : "") +
                        std::to_string(stack_.width_px) + " " + std::to_string(stack_.height_px) +
                        (sizeof(Number) == 1 ? "\n255\n" : "\n65535\n");
    bytes.reserve(bytes.size() + block.size());
    for (long long y = 0; y < stack_.height_px; ++y)
      for (long long x = 0; x < stack_.width_px; ++x)
        for (int c = 0; c < stack_.channels; ++c) {
          Number number;
          std::memcpy(&number, block.data() + place(y, x, c) * sizeof number, sizeof number);
          if (sizeof number > 1) bytes += static_cast<char>(number >> 8);
          bytes += static_cast<char>(number & 0xff);
        }
    return bytes;
  }

  template <typename Place>
  std::string fits(const std::string& block, ArrayKind kind, const Place& place) const {
    sim::Image image(
        static_cast<int>(stack_.width_px), static_cast<int>(stack_.height_px),
        stack_.channels == 1 ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"});
    std::size_t at = 0;
    for (long long y = 0; y < stack_.height_px; ++y)
      for (long long x = 0; x < stack_.width_px; ++x)
        for (int c = 0; c < stack_.channels; ++c)
          image.data[at++] = static_cast<float>(sim::number_of(block, kind, place(y, x, c)));
    return sim::encode_fits(image, {});
  }

  std::unique_ptr<sim::ArrayFile> file_;
  ImageStack stack_;
  std::vector<std::optional<ImagerTime>> times_;
  ImagerWords file_words_;
};

using sim::ArrayClock;
using sim::ArrayKind;
using sim::StoredArray;

constexpr double kDay_s = 86400.0;
constexpr double kDays1970 = 719528.0;                                   // from 0000-01-01 to 1970-01-01
constexpr double kDatenum1970 = kDays1970 + 1;                           // MATLAB counts 0000-01-01 as day 1
constexpr double kEarliest_s = -2208988800.0, kLatest_s = 7258118400.0;  // 1900, 2200

std::optional<double> in_range(double seconds) {
  return std::isfinite(seconds) && seconds >= kEarliest_s && seconds < kLatest_s
             ? std::optional<double>(seconds)
             : std::nullopt;
}

bool is_named_for_times(const std::string& name) {
  const std::string plain = sim::lowered(name.substr(name.rfind('/') + 1));
  return plain == "t" || plain == "datenum" || plain.find("time") != std::string::npos ||
         plain.find("epoch") != std::string::npos;
}

bool may_tell_times(const StoredArray& array, std::uint64_t frames) {
  const bool is_line =
      std::count_if(array.dims.begin(), array.dims.end(), [](std::uint64_t n) { return n != 1; }) <= 1;
  if (!is_line || array.count() != frames) return false;
  if (array.clock != ArrayClock::none) return true;
  return (array.kind == ArrayKind::text || array.kind == ArrayKind::f64 || sim::size_of(array.kind) >= 4) &&
         array.kind != ArrayKind::f32 && is_named_for_times(array.name);
}

/// The first that may, of those with a clock of their own before all others.
const StoredArray* times_of(const sim::ArrayFile& file, std::size_t images, std::uint64_t frames) {
  const StoredArray* found = nullptr;
  for (std::size_t i = 0; i < file.arrays().size(); ++i) {
    const StoredArray& array = file.arrays()[i];
    if (i == images || !may_tell_times(array, frames)) continue;
    if (array.clock != ArrayClock::none) return &array;
    if (found == nullptr) found = &array;
  }
  return found;
}

ImagerTime time_at(double seconds, const std::string& source) {
  ImagerTime time;
  time.seconds = seconds;
  // Milliseconds, or as many digits as a double has of them.
  time.utc = sim::utc_text(seconds);
  time.source = source;
  return time;
}

std::optional<double> seconds_of_number(double number) {
  constexpr double kEarliestDay = 693962.0, kLatestDay = 803534.0;  // MATLAB's of 1900 and 2200
  if (number >= kEarliestDay && number < kLatestDay) return in_range((number - kDatenum1970) * kDay_s);
  constexpr double kFirst_s = 3e8;  // 1979: before there were such images
  return number >= kFirst_s ? in_range(number) : std::nullopt;
}

std::optional<ImagerTime> time_of_text(std::string text, const std::string& source) {
  constexpr std::string_view kZone = " UTC";
  if (sim::ends_with(text, kZone)) text.erase(text.size() - kZone.size());
  const auto seconds = sim::utc_seconds(text);
  if (!seconds) return std::nullopt;
  ImagerTime time = time_at(*seconds, source);
  // The text as it is in the file, to the last digit.
  if (const auto civil = sim::civil_time(text)) time.utc = sim::iso_text(*civil) + "Z";
  return time;
}

}  // namespace

ImageStack find_images(const sim::ArrayFile& file, const std::string& wanted) {
  ImageStack stack;
  stack.arrays = images_of(file, wanted);
  const StoredArray& array = file.arrays()[stack.arrays[0]];
  const int dims = static_cast<int>(array.dims.size());
  std::vector<std::uint64_t> lengths = array.dims;
  if (array.columns_first) std::reverse(lengths.begin(), lengths.end());
  const Axes axes = axes_of_images(lengths, file, stack.arrays[0]);
  const std::uint64_t height = lengths[axes.row], width = lengths[axes.column];
  const std::uint64_t frames = axes.frame >= 0 ? lengths[axes.frame] : stack.arrays.size();
  if (axes.frame >= 0 && stack.arrays.size() > 1)
    throw sim::unreadable(file.name(), "'" + array.name + "' and others as large each hold several images")
        .expected("one array of them");
  // A few bytes of such a file may claim a large image, as with gzip.
  if (width > static_cast<std::uint64_t>(kMaxPackedPixels) ||
      height > static_cast<std::uint64_t>(kMaxPackedPixels) ||
      width * height > static_cast<std::uint64_t>(kMaxPackedPixels))
    throw sim::unreadable(file.name(), "'" + array.name + "' claims images of " + std::to_string(width) +
                                           " x " + std::to_string(height) + " pixels")
        .expected("at most 2^25 in all");
  sim::check_pixel_limit(static_cast<long long>(width), static_cast<long long>(height), file.name());
  if (frames > static_cast<std::uint64_t>(kMaxFrames))
    throw sim::unreadable(file.name(), "'" + array.name + "' claims " + std::to_string(frames) + " images")
        .expected("at most " + std::to_string(kMaxFrames))
        .hint("cut it up");
  if (frames == 0) throw sim::unreadable(file.name(), "'" + array.name + "' holds no image");
  stack.frames = static_cast<std::size_t>(frames);
  stack.width_px = static_cast<long long>(width);
  stack.height_px = static_cast<long long>(height);
  stack.channels = axes.channel >= 0 ? static_cast<int>(kThreeColours) : 1;
  const auto stored = [&](int axis) { return axis < 0 || !array.columns_first ? axis : dims - 1 - axis; };
  stack.frame_axis = stored(axes.frame);
  stack.row_axis = stored(axes.row);
  stack.column_axis = stored(axes.column);
  stack.channel_axis = stored(axes.channel);
  return stack;
}

std::unique_ptr<FrameStore> array_frames(std::unique_ptr<sim::ArrayFile> file, const std::string& wanted) {
  return std::make_unique<ArrayFrames>(std::move(file), wanted);
}

std::optional<double> cdf_epoch_seconds(double milliseconds) {
  constexpr double kMilliseconds = 1e-3;
  return in_range((milliseconds - kDays1970 * kDay_s * 1e3) * kMilliseconds);
}

std::optional<double> tt2000_seconds(std::int64_t nanoseconds) {
  // J2000 is 2000-01-01T12:00:00 of terrestrial time, which is 32.184 s before TAI.
  constexpr double kJ2000_s = 946728000.0, kNanoseconds = 1e-9;
  return in_range(
      sim::utc_of_tai(static_cast<double>(nanoseconds) * kNanoseconds + kJ2000_s - sim::kTtLessTai_s));
}

bool has_times(const sim::ArrayFile& file, std::size_t images, std::uint64_t frames) {
  return times_of(file, images, frames) != nullptr;
}

std::vector<std::optional<ImagerTime>> array_times(sim::ArrayFile& file, std::size_t images,
                                                   std::size_t frames) {
  const StoredArray* array = times_of(file, images, frames);
  if (array == nullptr) return {};
  const std::string source = std::string(file.format()) + " array \"" + array->name + "\"";
  std::vector<std::optional<ImagerTime>> times;
  if (array->kind == ArrayKind::text) {
    for (std::string& text : file.read_texts(*array)) times.push_back(time_of_text(std::move(text), source));
    return times;
  }
  const std::string block = file.read(*array);
  for (std::size_t i = 0; i < frames; ++i) {
    const double number = sim::number_of(block, array->kind, i);
    std::optional<double> seconds;
    if (array->clock == ArrayClock::cdf_epoch) {
      seconds = cdf_epoch_seconds(number);
    } else if (array->clock == ArrayClock::tt2000 && array->kind == ArrayKind::i64) {
      std::int64_t nanoseconds = 0;
      std::memcpy(&nanoseconds, block.data() + i * sizeof nanoseconds, sizeof nanoseconds);
      seconds = tt2000_seconds(nanoseconds);
    } else {
      seconds = seconds_of_number(number);
    }
    times.push_back(seconds ? std::optional<ImagerTime>(time_at(*seconds, source)) : std::nullopt);
  }
  return times;
}

}  // namespace vegard::fit
