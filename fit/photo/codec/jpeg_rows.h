// Decodes JPEG row by row: a large photograph is never in memory as a whole, and its rows are processed while
// they are in the processor's cache.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace vegard::fit {

/// Decodes a JPEG of 8 bits in the order of the file, without its EXIF orientation. The bytes must have been
/// checked (fit/photo/codec/picture_format.h) and must outlive the object; `file` is for messages.
/// Constructor and next_rows() throw sim::Error(unreadable_input) for data that libjpeg cannot decode, or
/// replaces by a guess.
class JpegRows {
 public:
  enum class Order { red_first, blue_first };

  JpegRows(std::string_view bytes, const std::string& file, Order order = Order::red_first);
  ~JpegRows();
  JpegRows(const JpegRows&) = delete;
  JpegRows& operator=(const JpegRows&) = delete;

  int width() const;
  int height() const;
  /// 1 (grey) or 3; 0 for other colour spaces, for which next_rows() must not be called.
  int channels() const;

  /// Decodes the next `count` rows, fewer at the picture's end, to `to`, one after the other with their
  /// channels interleaved. Returns the number of rows decoded.
  int next_rows(int count, std::uint8_t* to);

 private:
  struct Decoder;
  std::unique_ptr<Decoder> decoder_;
};

}  // namespace vegard::fit
