#include "fit/photo/codec/jpeg_rows.h"

#include <csetjmp>
#include <cstddef>
#include <cstdio>  // jpeglib.h needs it before

#include <jerror.h>
#include <jpeglib.h>

#include "sim/base/error.h"

namespace vegard::fit {

// libjpeg leaves by longjmp(), over whose way no object may need its destructor: everything lives here, and
// what jumps are taken in are functions of plain numbers.
struct JpegRows::Decoder {
  jpeg_decompress_struct info{};
  jpeg_error_mgr errors{};
  std::jmp_buf out{};
  std::string file;
  int channels = 0;
  bool damaged = false, is_in_scan = false;

  static void leave(j_common_ptr info) { std::longjmp(static_cast<Decoder*>(info->client_data)->out, 1); }
  static void be_silent(j_common_ptr) {}

  /// libjpeg makes up what damaged data do not say, and goes on with a warning.
  static void note(j_common_ptr info, int level) {
    constexpr int kWarning = -1;
    if (level != kWarning) return;
    auto* const decoder = static_cast<Decoder*>(info->client_data);
    for (const int code : {JWRN_HIT_MARKER, JWRN_JPEG_EOF, JWRN_HUFF_BAD_CODE, JWRN_MUST_RESYNC})
      if (info->err->msg_code == code) decoder->damaged = true;
    // Where bytes are missing, the rest is read as other pixels, and some of it is left over. Writers fill up
    // to a word of eight bytes, with zeros or ones. Strays between the segments of the header are none of the
    // picture's.
    constexpr int kFilling = 8;
    if (decoder->damaged || !decoder->is_in_scan || info->err->msg_code != JWRN_EXTRANEOUS_DATA) return;
    decoder->damaged = info->err->msg_parm.i[0] > kFilling || !decoder->is_filled(info->err->msg_parm.i[0]);
  }

  /// Whether nothing but filling is in the last bytes before the marker, which is read next. Between scans
  /// and before restart markers libjpeg does not say which bytes they were.
  bool is_filled(int bytes) const {
    if (info.progressive_mode || info.restart_interval > 0) return true;
    for (int i = 1; i <= bytes; ++i)
      if (const int byte = *(info.src->next_input_byte - i); byte != 0x00 && byte != 0xff) return false;
    return true;
  }

  /// False where libjpeg has given up.
  bool start(const unsigned char* bytes, std::size_t size, Order order) {
    info.err = jpeg_std_error(&errors);
    errors.error_exit = leave;
    errors.output_message = be_silent;
    errors.emit_message = note;
    info.client_data = this;
    if (setjmp(out) != 0) return false;
    jpeg_create_decompress(&info);
    info.client_data = this;
    jpeg_mem_src(&info, bytes, static_cast<unsigned long>(size));
    jpeg_read_header(&info, TRUE);
    const bool grey = info.jpeg_color_space == JCS_GRAYSCALE;
    if (!grey && info.jpeg_color_space != JCS_YCbCr && info.jpeg_color_space != JCS_RGB) return true;
    info.out_color_space = grey ? JCS_GRAYSCALE : order == Order::blue_first ? JCS_EXT_BGR : JCS_RGB;
    is_in_scan = true;
    jpeg_start_decompress(&info);
    channels = info.output_components;
    return true;
  }

  /// The number of rows; -1 where libjpeg has given up.
  int read(int count, unsigned char* to) {
    if (setjmp(out) != 0) return -1;
    const std::size_t of_row = static_cast<std::size_t>(info.output_width) * channels;
    const auto before = info.output_scanline;
    while (static_cast<int>(info.output_scanline - before) < count &&
           info.output_scanline < info.output_height) {
      unsigned char* row = to + (info.output_scanline - before) * of_row;
      jpeg_read_scanlines(&info, &row, 1);
    }
    return static_cast<int>(info.output_scanline - before);
  }

  /// False where libjpeg has given up.
  bool finish() {
    if (setjmp(out) != 0) return false;
    jpeg_finish_decompress(&info);
    return true;
  }

  sim::Error undecodable() const {
    return sim::unreadable(file, "the image cannot be decoded")
        .expected("a sound JPEG")
        .hint("open it in an image viewer and save it again");
  }
};

JpegRows::JpegRows(std::string_view bytes, const std::string& file, Order order)
    : decoder_(std::make_unique<Decoder>()) {
  decoder_->file = file;
  if (decoder_->start(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), order)) return;
  jpeg_destroy_decompress(&decoder_->info);
  throw decoder_->undecodable();
}

JpegRows::~JpegRows() { jpeg_destroy_decompress(&decoder_->info); }

int JpegRows::width() const { return static_cast<int>(decoder_->info.image_width); }
int JpegRows::height() const { return static_cast<int>(decoder_->info.image_height); }
int JpegRows::channels() const { return decoder_->channels; }

int JpegRows::next_rows(int count, std::uint8_t* to) {
  const int rows = decoder_->read(count, to);
  if (rows < 0) throw decoder_->undecodable();
  // What stands behind the last row is looked at as well.
  if (rows > 0 && decoder_->info.output_scanline == decoder_->info.output_height && !decoder_->finish())
    throw decoder_->undecodable();
  if (decoder_->damaged) throw sim::damaged(decoder_->file, "its compressed data are not sound");
  return rows;
}

}  // namespace vegard::fit
