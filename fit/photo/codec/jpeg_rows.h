// JPEG row by row: a large photograph never stands in memory as a whole, and whatever is made of its rows is
// made while they are in the processor's cache.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace vegard::fit {

/// A JPEG of 8 bits, decoded as the file has it, before its EXIF orientation. The bytes have been walked
/// (fit/photo/codec/image_walk.h) and must outlive it; `file` is for messages. Constructor and next_rows()
/// throw sim::Error(unreadable_input) for what libjpeg cannot decode, or makes up.
class JpegRows {
 public:
  JpegRows(std::string_view bytes, const std::string& file);
  ~JpegRows();
  JpegRows(const JpegRows&) = delete;
  JpegRows& operator=(const JpegRows&) = delete;

  int width() const;
  int height() const;
  /// 1 (grey) or 3 (red, green, blue); 0 for colours of other kinds, whose rows are not to be asked for.
  int channels() const;

  /// Decodes the next `count` rows, fewer where the picture ends, to `to`, one behind the other with their
  /// channels interleaved. Returns how many there were.
  int next_rows(int count, std::uint8_t* to);

 private:
  struct Decoder;
  std::unique_ptr<Decoder> decoder_;
};

}  // namespace vegard::fit
