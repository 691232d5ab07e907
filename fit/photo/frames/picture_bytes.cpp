#include "fit/photo/frames/picture_bytes.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <system_error>
#include <utility>

#include "fit/photo/frames/store_kinds.h"
#include "sim/base/error.h"
#include "sim/base/file/byte_stream.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/sha256.h"

namespace vegard::fit {
namespace {

std::string bytes_of_file(const std::string& file) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status))
    throw sim::unreadable(file, error ? error.message() : "no such file")
        .expected("an image file")
        .hint("check the path");
  if (fs::is_directory(status)) throw sim::unreadable(file, "this is a folder").expected("an image file");
  if (!fs::is_regular_file(status))
    throw sim::unreadable(file, "this is not a regular file").expected("an image file");
  const auto size = fs::file_size(file, error);
  if (error) throw sim::unreadable(file, error.message());
  // cv::imdecode counts bytes in an int, and no photograph has more.
  if (size > static_cast<std::uintmax_t>(std::numeric_limits<int>::max()))
    throw sim::unreadable(file, "the file is larger than 2 GiB").hint("scale or crop it first");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw sim::unreadable(file, "the file cannot be opened").hint("check its permissions");
  std::string bytes(size, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  if (static_cast<std::uintmax_t>(stream.gcount()) != size)
    throw sim::unreadable(file, "the file cannot be read to its end");
  return bytes;
}

constexpr std::string_view kFitsBegins = "SIMPLE  =";

bool is_packed_fits(sim::ByteStream& stream) {
  return stream.is_packed() && stream.look(kFitsBegins.size()) == kFitsBegins;
}

/// A FITS file that gzip has packed; nothing of any other kind. It is gone through for its size, and then
/// read into room for that.
std::optional<std::string> unpacked_fits(const std::string& file) {
  sim::ByteStream first(file);
  if (!is_packed_fits(first)) return std::nullopt;
  const std::uint64_t size = first.skip(kMaxUnpackedFits + 1);
  if (size > kMaxUnpackedFits)
    throw sim::unreadable(file, "the FITS file in it is larger than " + sim::bytes_text(kMaxUnpackedFits))
        .hint("unpack it first");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  sim::ByteStream again(file);
  bytes.resize(again.read(bytes.data(), bytes.size()));
  return bytes;
}

sim::Error no_such_frame(const std::string& file, int number, std::size_t frames) {
  return sim::Error(sim::ErrorKind::usage, "there is no frame " + std::to_string(number) + " in it")
      .file(file)
      .expected(numbers_text(frames));
}

/// Frames of a file, and the one among them that is wanted.
struct Chosen {
  std::vector<FrameHead> heads;
  PictureBytes picture;
  bool is_plain = false;
};

Chosen go_through(const FrameName& wanted) {
  FrameReader reader(wanted.file);
  Chosen chosen;
  chosen.is_plain = reader.is_plain();
  double nearest_s = std::numeric_limits<double>::infinity();
  while (reader.next()) {
    const FrameHead& head = reader.head();
    chosen.heads.push_back(head);
    bool is_it = wanted.is_chosen() ? wanted.number == head.number : head.number == 0;
    if (wanted.utc_s && head.time) {
      const double away_s = std::abs(head.time->seconds - *wanted.utc_s);
      is_it = away_s < nearest_s;
      nearest_s = std::min(nearest_s, away_s);
    }
    if (!is_it) continue;
    chosen.picture.frame = head;
    chosen.picture.words = reader.words();
    chosen.picture.bytes = reader.take();
  }
  if (wanted.utc_s) frame_at(chosen.heads, *wanted.utc_s, wanted.file);
  if (!chosen.picture.frame) throw no_such_frame(wanted.file, *wanted.number, chosen.heads.size());
  return chosen;
}

}  // namespace

PictureBytes read_picture_bytes(const std::string& name) {
  const FrameName wanted = frame_name(name);
  // A file that cannot be opened is reported as for any picture.
  const std::string path = path_of_frames(wanted.file);
  const bool is_readable = sim::why_no_input(path).empty();
  if (!is_readable || !is_frame_file(wanted.file)) {
    PictureBytes picture;
    picture.name = wanted.file;
    if (std::optional<std::string> fits = is_readable ? unpacked_fits(wanted.file) : std::nullopt) {
      picture.bytes = std::move(*fits);
      picture.file_sha256 = sim::sha256_of_file(wanted.file);
    } else {
      picture.bytes = bytes_of_file(wanted.file);
    }
    if (wanted.is_chosen())
      throw sim::Error(sim::ErrorKind::usage, "there are no frames in it to choose from")
          .file(wanted.file)
          .expected("its name without a frame's number or time");
    return picture;
  }
  Chosen chosen = go_through(wanted);
  PictureBytes picture = std::move(chosen.picture);
  picture.name = wanted.file;
  if (chosen.heads.size() > 1) {
    if (!wanted.is_chosen()) throw no_frame_chosen(chosen.heads, wanted.file);
    picture.name = name_of_frame(wanted.file, picture.frame->number);
  } else if (!chosen.is_plain) {
    picture.file_sha256 = sim::sha256_of_file(path);
  } else {
    picture.bytes = bytes_of_file(wanted.file);
  }
  return picture;
}

std::string beginning_of_packed_fits(const std::string& file) {
  sim::ByteStream stream(file);
  if (!is_packed_fits(stream)) return {};
  return std::string(stream.look(sim::kMaxPeekBytes));
}

std::optional<PictureBytes> PictureSeries::next_of_file(const FrameName& wanted) {
  const int number = *wanted.number;
  const bool is_behind =
      reader_ != nullptr && file_ == wanted.file &&
      (reader_->head().number < number || (reader_->head().number == number && !is_taken_));
  if (!is_behind) {
    reader_ = std::make_unique<FrameReader>(wanted.file);
    file_ = wanted.file;
  }
  bool is_there = true;
  while (is_there && reader_->head().number < number) is_there = reader_->next();
  if (!is_there) return std::nullopt;
  PictureBytes picture;
  picture.frame = reader_->head();
  picture.words = reader_->words();
  picture.bytes = reader_->take();
  picture.name = name_of_frame(wanted.file, number);
  is_taken_ = true;
  // A file's only frame is a picture like any other. What is damaged behind the first is not the only one.
  try {
    if (number == 0) {
      if (!reader_->next()) return std::nullopt;
      is_taken_ = false;
    }
  } catch (const sim::Error&) {
    reader_.reset();
  }
  return picture;
}

PictureBytes PictureSeries::read(const std::string& name) {
  const FrameName wanted = frame_name(name);
  if (!wanted.number || !is_frame_file(wanted.file)) return read_picture_bytes(name);
  try {
    if (std::optional<PictureBytes> picture = next_of_file(wanted)) return std::move(*picture);
  } catch (const sim::Error&) {
    // A frame behind the damage is reported as if it were read alone.
    reader_.reset();
    throw;
  }
  reader_.reset();
  return read_picture_bytes(name);
}

std::vector<NamedPicture> pictures_in(const std::string& name) {
  const FrameName wanted = frame_name(name);
  if (!is_frame_file(wanted.file)) return {{name, {}, {}}};
  const std::vector<FrameHead> frames = frame_index(wanted.file).frames;
  std::vector<NamedPicture> pictures;
  for (const FrameHead& frame : frames)
    pictures.push_back({frames.size() > 1 ? name_of_frame(wanted.file, frame.number) : wanted.file,
                        frame.time, frame.stream});
  if (!wanted.is_chosen()) return pictures;
  const int number = wanted.number ? *wanted.number : frame_at(frames, *wanted.utc_s, wanted.file);
  if (number >= static_cast<int>(frames.size())) throw no_such_frame(wanted.file, number, frames.size());
  return {pictures[number]};
}

}  // namespace vegard::fit
