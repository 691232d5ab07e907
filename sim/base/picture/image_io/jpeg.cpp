#include <csetjmp>
#include <cstdint>
#include <cstdio>  // jpeglib.h needs it before
#include <cstdlib>

#include <jerror.h>
#include <jpeglib.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "sim/base/picture/image_io/library.h"

namespace vegard::sim {
namespace {

/// EXIF shares the 65 533 bytes of its segment with nothing else, but programs give up far below.
constexpr std::size_t kDescriptionLimit = 30000;
constexpr std::size_t kExifTimeBytes = 19;

void append_number(std::string& bytes, std::uint32_t number, int size) {
  for (int i = 0; i < size; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xff);
}

/// Of UTF-8, no character of which is cut.
std::string first_bytes(std::string text, std::size_t most) {
  if (text.size() <= most) return text;
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xc0) == 0x80) --most;
  text.resize(most);
  return text;
}

/// A TIFF of one directory, little-endian, with texts by their tags (TIFF 6.0, section 2; EXIF 2.32, 4.6.4),
/// as it stands in a JPEG's segment APP1. Empty for no texts.
std::string exif_segment(const std::vector<std::pair<std::uint32_t, std::string>>& texts) {
  if (texts.empty()) return {};
  constexpr std::uint32_t kAscii = 2, kHeadBytes = 8, kEntryBytes = 12;
  const auto count = static_cast<std::uint32_t>(texts.size());
  std::uint32_t place = kHeadBytes + 2 + kEntryBytes * count + 4;
  std::string segment("Exif\0\0II*\0", 10), values;
  append_number(segment, kHeadBytes, 4);
  append_number(segment, count, 2);
  for (const auto& [tag, text] : texts) {
    constexpr std::uint32_t kShort = 4;  // what stands in the entry itself
    const auto length = static_cast<std::uint32_t>(text.size() + 1);
    append_number(segment, tag, 2);
    append_number(segment, kAscii, 2);
    append_number(segment, length, 4);
    if (length <= kShort) {
      segment += text;
      segment.append(kShort - text.size(), '\0');
      continue;
    }
    append_number(segment, place, 4);
    values += text;
    values.append(1 + length % 2, '\0');  // each begins at an even place
    place += length + length % 2;
  }
  append_number(segment, 0, 4);  // no directory follows
  return segment + values;
}

/// What libjpeg leaves by longjmp() has no destructor.
struct JpegContent {
  JDIMENSION width, height;
  int channels, quality;
  const unsigned char* pixels;
  std::string_view exif, words;
};

struct JpegWriter {
  jpeg_compress_struct info{};
  jpeg_error_mgr errors{};
  jpeg_destination_mgr destination{};
  std::jmp_buf out{};
  unsigned char* bytes = nullptr;  // of malloc(): nothing may be thrown through libjpeg
  std::size_t room = 0, size = 0;
  char complaint[JMSG_LENGTH_MAX] = {};

  JpegWriter() = default;
  JpegWriter(const JpegWriter&) = delete;
  JpegWriter& operator=(const JpegWriter&) = delete;
  ~JpegWriter() {
    jpeg_destroy_compress(&info);
    std::free(bytes);
  }

  static void leave(j_common_ptr info) {
    auto* const writer = static_cast<JpegWriter*>(info->client_data);
    info->err->format_message(info, writer->complaint);
    std::longjmp(writer->out, 1);
  }
  static void be_silent(j_common_ptr) {}

  /// Doubles the room; what is in it stays.
  static void grow(j_compress_ptr info) {
    constexpr std::size_t kFirst = std::size_t{1} << 16;
    auto* const writer = static_cast<JpegWriter*>(info->client_data);
    const std::size_t more = writer->room == 0 ? kFirst : writer->room;
    void* const larger = std::realloc(writer->bytes, writer->room + more);
    if (larger == nullptr) ERREXIT1(info, JERR_OUT_OF_MEMORY, 0);
    writer->bytes = static_cast<unsigned char*>(larger);
    info->dest->next_output_byte = writer->bytes + writer->room;
    info->dest->free_in_buffer = more;
    writer->room += more;
  }
  static boolean grow_when_full(j_compress_ptr info) {
    grow(info);
    return TRUE;
  }
  static void finish(j_compress_ptr info) {
    auto* const writer = static_cast<JpegWriter*>(info->client_data);
    writer->size = writer->room - info->dest->free_in_buffer;
  }

  void mark(int marker, std::string_view bytes_of_it) {
    if (!bytes_of_it.empty())
      jpeg_write_marker(&info, marker, reinterpret_cast<const unsigned char*>(bytes_of_it.data()),
                        static_cast<unsigned int>(bytes_of_it.size()));
  }

  /// False where libjpeg has given up.
  bool put(const JpegContent& content) {
    info.err = jpeg_std_error(&errors);
    errors.error_exit = leave;
    errors.output_message = be_silent;
    info.client_data = this;
    if (setjmp(out) != 0) return false;
    jpeg_create_compress(&info);
    info.client_data = this;
    destination.init_destination = grow;
    destination.empty_output_buffer = grow_when_full;
    destination.term_destination = finish;
    info.dest = &destination;
    info.image_width = content.width;
    info.image_height = content.height;
    info.input_components = content.channels;
    info.in_color_space = content.channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_set_defaults(&info);
    jpeg_set_quality(&info, content.quality, TRUE);
    // Aurorae are thin coloured lines: no subsampling of the colours.
    info.comp_info[0].h_samp_factor = info.comp_info[0].v_samp_factor = 1;
    jpeg_start_compress(&info, TRUE);
    mark(JPEG_APP0 + 1, content.exif);
    mark(JPEG_COM, content.words);
    const std::size_t row_bytes = static_cast<std::size_t>(content.width) * content.channels;
    while (info.next_scanline < info.image_height) {
      auto* row = const_cast<JSAMPROW>(content.pixels + info.next_scanline * row_bytes);
      jpeg_write_scanlines(&info, &row, 1);
    }
    jpeg_finish_compress(&info);
    return true;
  }
};

}  // namespace

std::string encode_jpeg(const PictureLayout& layout, int quality, const ImageAttributes& attributes,
                        const unsigned char* pixels, const std::string& name) {
  constexpr std::uint32_t kImageDescription = 270, kDateTime = 306;
  std::vector<std::pair<std::uint32_t, std::string>> texts;
  const std::string words = first_bytes(description_of(attributes), kDescriptionLimit);
  if (!words.empty()) texts.emplace_back(kImageDescription, words);
  if (const std::string time = exif_time(value_or_empty(attributes, "DateTime"));
      time.size() == kExifTimeBytes && time != unknown_time)
    texts.emplace_back(kDateTime, time);
  const std::string exif = exif_segment(texts);

  JpegContent content{};
  content.width = static_cast<JDIMENSION>(layout.width);
  content.height = static_cast<JDIMENSION>(layout.height);
  content.channels = layout.channels;
  content.quality = quality;
  content.pixels = pixels;
  content.exif = exif;
  content.words = words;
  JpegWriter writer;
  if (!writer.put(content))
    throw failure(ErrorKind::unwritable_output, name, std::string("cannot be encoded: ") + writer.complaint);
  return {reinterpret_cast<const char*>(writer.bytes), writer.size};
}

}  // namespace vegard::sim
