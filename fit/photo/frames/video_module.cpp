#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/display.h>
#include <libavutil/imgutils.h>
#include <libavutil/pixdesc.h>
#include <libswscale/swscale.h>
}

#include "fit/photo/frames/video_reader.h"
#include "sim/base/module.h"

namespace vegard::fit {
namespace {

constexpr int kUnspecified = 2;  // ITU-T H.273

template <typename Thing, void (*free_it)(Thing**)>
struct FreeBy {
  void operator()(Thing* thing) const { free_it(&thing); }
};
using Packet = std::unique_ptr<AVPacket, FreeBy<AVPacket, av_packet_free>>;
using Frame = std::unique_ptr<AVFrame, FreeBy<AVFrame, av_frame_free>>;
using Decoder = std::unique_ptr<AVCodecContext, FreeBy<AVCodecContext, avcodec_free_context>>;
struct FreeScaler {
  void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
};

struct Cursor {
  const VideoBytes* bytes = nullptr;
  std::uint64_t at = 0;
};

int read_bytes(void* opaque, std::uint8_t* to, int count) {
  auto& cursor = *static_cast<Cursor*>(opaque);
  const std::size_t got =
      cursor.bytes->read(cursor.at, reinterpret_cast<char*>(to), static_cast<std::size_t>(count));
  cursor.at += got;
  return got == 0 ? AVERROR_EOF : static_cast<int>(got);
}

std::int64_t seek_bytes(void* opaque, std::int64_t to, int whence) {
  auto& cursor = *static_cast<Cursor*>(opaque);
  const auto size = static_cast<std::int64_t>(cursor.bytes->size());
  if (whence == AVSEEK_SIZE) return size;
  const int from = whence & ~AVSEEK_FORCE;
  if (from == SEEK_CUR) to += static_cast<std::int64_t>(cursor.at);
  if (from == SEEK_END) to += size;
  if (to < 0) return AVERROR(EINVAL);
  cursor.at = static_cast<std::uint64_t>(to);
  return to;
}

/// A film may name other files (references of QuickTime): none is opened.
int open_nothing(AVFormatContext*, AVIOContext**, const char*, int, AVDictionary**) { return AVERROR(EPERM); }

std::string word_of(const AVDictionary* words, const char* key) {
  const AVDictionaryEntry* const found = av_dict_get(words, key, nullptr, 0);
  return found != nullptr ? found->value : "";
}

/// The picture format without the mark of the full range, which is told apart.
AVPixelFormat plain_format(AVPixelFormat format) {
  switch (format) {
    case AV_PIX_FMT_YUVJ420P:
      return AV_PIX_FMT_YUV420P;
    case AV_PIX_FMT_YUVJ422P:
      return AV_PIX_FMT_YUV422P;
    case AV_PIX_FMT_YUVJ444P:
      return AV_PIX_FMT_YUV444P;
    case AV_PIX_FMT_YUVJ440P:
      return AV_PIX_FMT_YUV440P;
    case AV_PIX_FMT_YUVJ411P:
      return AV_PIX_FMT_YUV411P;
    default:
      return format;
  }
}

struct Shown {
  std::int64_t time = 0;  ///< in units of the stream
  bool is_key = false;
};

class FfmpegVideo : public VideoReader {
 public:
  ~FfmpegVideo() override { close(); }

  std::string open(const VideoBytes& bytes, VideoContainer container, long long max_pixels,
                   std::size_t max_frames) override {
    av_log_set_level(AV_LOG_QUIET);
    bytes_ = &bytes;
    max_pixels_ = max_pixels;
    container_ = container;
    std::string problem = open_container();
    if (problem.empty()) problem = take_facts();
    if (problem.empty()) problem = list_frames(max_frames);
    if (problem.empty()) problem = start_again();
    return problem;
  }

  const VideoFacts& facts() const override { return facts_; }
  const std::vector<double>& seconds() const override { return seconds_; }

  std::string picture(std::size_t number, std::string& pixels) override {
    if (!decoder_)  // the file was another when it was last read
      if (const std::string problem = start_again(); !problem.empty()) return problem;
    const std::size_t key = key_before(number);
    bool has_jumped = false;
    if (number < next_ || (has_own_times_ && key > next_ + kFewFrames)) {
      has_jumped = has_own_times_ && key > 0 && jump(key);
      if (!has_jumped)
        if (const std::string problem = start_again(); !problem.empty()) return problem;
    }
    std::string problem = decode_until(number);
    if (!problem.empty() && has_jumped) {
      // What a jump leads to may lean on frames before it.
      problem = start_again();
      if (problem.empty()) problem = decode_until(number);
    }
    return problem.empty() ? convert(pixels) : problem;
  }

 private:
  static constexpr std::size_t kFewFrames = 2;  // that are decoded rather than jumped over

  void close() {
    decoder_.reset();
    avformat_close_input(&film_);
    if (io_ != nullptr) {
      av_freep(&io_->buffer);
      avio_context_free(&io_);
    }
  }

  std::string open_container() {
    close();
    constexpr int kBuffer = 1 << 16;
    cursor_ = {bytes_, 0};
    film_ = avformat_alloc_context();
    auto* const buffer = static_cast<unsigned char*>(av_malloc(kBuffer));
    io_ = avio_alloc_context(buffer, kBuffer, 0, &cursor_, read_bytes, nullptr, seek_bytes);
    film_->pb = io_;
    film_->flags |= AVFMT_FLAG_CUSTOM_IO;
    film_->io_open = open_nothing;
    const char* const name = container_ == VideoContainer::mp4   ? "mov"
                             : container_ == VideoContainer::avi ? "avi"
                                                                 : "matroska";
    if (avformat_open_input(&film_, nullptr, av_find_input_format(name), nullptr) < 0)
      return "its index is missing or damaged: was the recording cut off?";
    std::vector<AVDictionary*> options(film_->nb_streams, nullptr);
    for (AVDictionary*& one : options) av_dict_set_int(&one, "max_pixels", max_pixels_, 0);
    const int looked = avformat_find_stream_info(film_, options.empty() ? nullptr : options.data());
    for (AVDictionary*& one : options) av_dict_free(&one);
    if (looked < 0) return "it is damaged";
    const AVCodec* codec = nullptr;
    stream_ = av_find_best_stream(film_, AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0);
    if (stream_ == AVERROR_DECODER_NOT_FOUND) return "FFmpeg has no decoder for its film";
    const bool is_cover =
        stream_ >= 0 && (film_->streams[stream_]->disposition & AV_DISPOSITION_ATTACHED_PIC) != 0;
    if (stream_ < 0 || is_cover)
      return film_->nb_streams == 0 ? "there is nothing in it" : "there is only sound in it";
    for (unsigned i = 0; i < film_->nb_streams; ++i)
      if (static_cast<int>(i) != stream_) film_->streams[i]->discard = AVDISCARD_ALL;
    codec_ = codec;
    const AVCodecParameters& of = *stream().codecpar;
    if (of.width <= 0 || of.height <= 0 || of.format < 0)
      return "there is no frame in it that can be decoded";
    if (static_cast<long long>(of.width) * of.height > max_pixels_)
      return "its frames have " + std::to_string(of.width) + " x " + std::to_string(of.height) +
             " pixels, more than 2^25";
    return {};
  }

  AVStream& stream() const { return *film_->streams[stream_]; }

  std::string take_facts() {
    const AVCodecParameters& of = *stream().codecpar;
    const auto stored = static_cast<AVPixelFormat>(of.format);
    format_ = plain_format(stored);
    const AVPixFmtDescriptor& pixels = *av_pix_fmt_desc_get(format_);
    facts_ = {};
    facts_.codec = avcodec_get_name(of.codec_id);
    facts_.width_px = of.width;
    facts_.height_px = of.height;
    const AVRational aspect = of.sample_aspect_ratio;
    facts_.has_square_pixels = aspect.num == 0 || aspect.num == aspect.den;
    const int colours = pixels.nb_components - ((pixels.flags & AV_PIX_FMT_FLAG_ALPHA) != 0 ? 1 : 0);
    const bool has_palette = (pixels.flags & AV_PIX_FMT_FLAG_PAL) != 0;
    facts_.is_rgb = has_palette || (pixels.flags & (AV_PIX_FMT_FLAG_RGB | AV_PIX_FMT_FLAG_BAYER)) != 0;
    facts_.channels = colours < 3 && !facts_.is_rgb ? 1 : 3;
    constexpr int kByte = 8;
    facts_.bytes_a_value = pixels.comp[0].depth > kByte ? 2 : 1;
    facts_.primaries = of.color_primaries;
    facts_.transfer = of.color_trc;
    facts_.matrix = of.color_space;
    facts_.declares_range = stored != format_ || of.color_range != AVCOL_RANGE_UNSPECIFIED;
    const bool is_full = stored != format_ || of.color_range == AVCOL_RANGE_JPEG || facts_.is_rgb ||
                         (of.color_range == AVCOL_RANGE_UNSPECIFIED && facts_.channels == 1);
    facts_.has_limited_range = !is_full;
    constexpr int kHighDefinition_px = 720;
    facts_.matrix_used = facts_.matrix != kUnspecified      ? facts_.matrix
                         : of.codec_id == AV_CODEC_ID_MJPEG ? AVCOL_SPC_SMPTE170M
                         : of.height >= kHighDefinition_px  ? AVCOL_SPC_BT709
                                                            : AVCOL_SPC_SMPTE170M;
    facts_.creation_time = word_of(film_->metadata, "creation_time");
    if (facts_.creation_time.empty()) facts_.creation_time = word_of(stream().metadata, "creation_time");
    facts_.quicktime_date = word_of(film_->metadata, "com.apple.quicktime.creationdate");
    facts_.location = word_of(film_->metadata, "com.apple.quicktime.location.ISO6709");
    if (facts_.location.empty()) facts_.location = word_of(film_->metadata, "location");
    const auto* const matrix = reinterpret_cast<const std::int32_t*>(
        av_stream_get_side_data(&stream(), AV_PKT_DATA_DISPLAYMATRIX, nullptr));
    constexpr double kQuarter_deg = 90.0, kAlmost_deg = 1.0;
    if (matrix == nullptr) return {};
    const double turned = av_display_rotation_get(matrix);  // anticlockwise
    const double area =
        static_cast<double>(matrix[0]) * matrix[4] - static_cast<double>(matrix[1]) * matrix[3];
    if (!std::isfinite(turned) || area < 0.0 || std::abs(std::remainder(turned, kQuarter_deg)) > kAlmost_deg)
      return "its pictures are to be mirrored, or turned by no quarter";
    facts_.quarter_turns = (4 - static_cast<int>(std::lround(turned / kQuarter_deg))) % 4;
    return {};
  }

  std::string list_frames(std::size_t max_frames) {
    const Packet packet(av_packet_alloc());
    const AVCodecDescriptor* const about = avcodec_descriptor_get(stream().codecpar->codec_id);
    const bool reorders = about == nullptr || (about->props & AV_CODEC_PROP_REORDER) != 0;
    has_own_times_ = true;
    shown_.clear();
    int got = 0;
    for (; (got = av_read_frame(film_, packet.get())) >= 0; av_packet_unref(packet.get())) {
      if (packet->stream_index != stream_ || (packet->flags & AV_PKT_FLAG_DISCARD) != 0) continue;
      if (packet->size == 0) continue;  // a frame that the recorder has dropped
      if ((packet->flags & AV_PKT_FLAG_CORRUPT) != 0) {
        facts_.is_cut = true;
        break;
      }
      if (shown_.size() >= max_frames) {
        av_packet_unref(packet.get());
        return "there are more than " + std::to_string(max_frames) + " frames in it";
      }
      std::int64_t time = packet->pts;
      if (time == AV_NOPTS_VALUE) {
        if (reorders) has_own_times_ = false;
        time = packet->dts;
      }
      if (time == AV_NOPTS_VALUE) has_own_times_ = false;
      if (time == AV_NOPTS_VALUE)
        time = shown_.empty() ? 0 : shown_.back().time + std::max<std::int64_t>(packet->duration, 1);
      shown_.push_back({time, (packet->flags & AV_PKT_FLAG_KEY) != 0});
    }
    av_packet_unref(packet.get());
    if (shown_.empty()) return "there is no frame in it";
    std::stable_sort(shown_.begin(), shown_.end(),
                     [](const Shown& a, const Shown& b) { return a.time < b.time; });
    const double unit_s = av_q2d(stream().time_base);
    seconds_.clear();
    for (std::size_t i = 0; i < shown_.size(); ++i) {
      seconds_.push_back(static_cast<double>(shown_[i].time - shown_[0].time) * unit_s);
      if (i > 0 && shown_[i].time == shown_[i - 1].time) has_own_times_ = false;
    }
    return {};
  }

  std::size_t key_before(std::size_t number) const {
    while (number > 0 && !shown_[number].is_key) --number;
    return number;
  }

  std::string start_decoder() {
    decoder_.reset(avcodec_alloc_context3(codec_));
    avcodec_parameters_to_context(decoder_.get(), stream().codecpar);
    decoder_->pkt_timebase = stream().time_base;
    decoder_->thread_count = 1;
    decoder_->max_pixels = max_pixels_;
    decoder_->err_recognition = AV_EF_CRCCHECK | AV_EF_BITSTREAM | AV_EF_BUFFER | AV_EF_EXPLODE;
    decoder_->error_concealment = 0;
    if (avcodec_open2(decoder_.get(), codec_, nullptr) < 0) return "its decoder cannot be started";
    is_at_end_ = false;
    return {};
  }

  std::string start_again() {
    std::string problem = open_container();
    if (problem.empty()) problem = start_decoder();
    next_ = 0;
    return problem;
  }

  bool jump(std::size_t key) {
    if (av_seek_frame(film_, stream_, shown_[key].time, AVSEEK_FLAG_BACKWARD) < 0) return false;
    avcodec_flush_buffers(decoder_.get());
    is_at_end_ = false;
    next_ = kAnywhere;
    return true;
  }

  /// The number of the frame that was decoded last; none for one that is not in the list.
  std::size_t number_of_frame() const {
    if (!has_own_times_) return next_;
    const std::int64_t time = frame_->best_effort_timestamp;
    const auto at = std::lower_bound(shown_.begin(), shown_.end(), time,
                                     [](const Shown& one, std::int64_t t) { return one.time < t; });
    return at != shown_.end() && at->time == time ? static_cast<std::size_t>(at - shown_.begin()) : kAnywhere;
  }

  std::string decode_until(std::size_t number) {
    while (true) {
      const int got = avcodec_receive_frame(decoder_.get(), frame_.get());
      if (got == AVERROR(EAGAIN)) {
        if (!feed()) return cannot_decode(number);
        continue;
      }
      if (got < 0) return cannot_decode(number);
      const std::size_t now = number_of_frame();
      if (now == kAnywhere) continue;
      next_ = now + 1;
      if (now < number) continue;
      const bool is_whole = (frame_->flags & AV_FRAME_FLAG_CORRUPT) == 0 && frame_->decode_error_flags == 0;
      if (now > number || !is_whole) return cannot_decode(number);
      return {};
    }
  }

  static std::string cannot_decode(std::size_t number) {
    return "its frame " + std::to_string(number) + " cannot be decoded";
  }

  /// Gives the decoder the next packet, or the end; false if there is no more to give or it is refused.
  bool feed() {
    if (is_at_end_) return false;
    const Packet packet(av_packet_alloc());
    while (true) {
      if (av_read_frame(film_, packet.get()) < 0) {
        is_at_end_ = true;
        return avcodec_send_packet(decoder_.get(), nullptr) >= 0;
      }
      const bool is_ours = packet->stream_index == stream_ && packet->size > 0;
      const int sent = is_ours ? avcodec_send_packet(decoder_.get(), packet.get()) : 0;
      av_packet_unref(packet.get());
      if (is_ours) return sent >= 0;
    }
  }

  std::string convert(std::string& pixels) {
    const AVFrame& frame = *frame_;
    if (frame.width != facts_.width_px || frame.height != facts_.height_px)
      return "its frame " + std::to_string(next_ - 1) + " has another size than the first";
    const auto source = plain_format(static_cast<AVPixelFormat>(frame.format));
    const bool is_wide = facts_.bytes_a_value > 1;
    const AVPixelFormat target = facts_.channels == 1 ? (is_wide ? AV_PIX_FMT_GRAY16BE : AV_PIX_FMT_GRAY8)
                                                      : (is_wide ? AV_PIX_FMT_RGB48BE : AV_PIX_FMT_RGB24);
    const std::unique_ptr<SwsContext, FreeScaler> scaler(sws_getContext(
        frame.width, frame.height, source, frame.width, frame.height, target,
        SWS_BILINEAR | SWS_FULL_CHR_H_INT | SWS_FULL_CHR_H_INP | SWS_ACCURATE_RND | SWS_BITEXACT, nullptr,
        nullptr, nullptr));
    if (scaler == nullptr) return "its pixels are of a kind that is not known";
    const int* const matrix = sws_getCoefficients(facts_.matrix_used);
    constexpr int kOne = 1 << 16;
    sws_setColorspaceDetails(scaler.get(), matrix, facts_.has_limited_range ? 0 : 1, matrix, 1, 0, kOne,
                             kOne);
    const std::size_t row = static_cast<std::size_t>(frame.width) * facts_.channels * facts_.bytes_a_value;
    // The converter writes whole vectors, beyond the end of a row.
    constexpr std::size_t kRoom = 64;
    const std::size_t stride = (row + 2 * kRoom - 1) / kRoom * kRoom;
    std::string padded(stride * frame.height + kRoom, '\0');
    std::uint8_t* rows[4] = {reinterpret_cast<std::uint8_t*>(padded.data()), nullptr, nullptr, nullptr};
    const int strides[4] = {static_cast<int>(stride), 0, 0, 0};
    if (sws_scale(scaler.get(), frame.data, frame.linesize, 0, frame.height, rows, strides) != frame.height)
      return "its pixels cannot be converted";
    pixels.resize(row * frame.height);
    for (int y = 0; y < frame.height; ++y) padded.copy(pixels.data() + y * row, row, y * stride);
    return {};
  }

  static constexpr std::size_t kAnywhere = std::numeric_limits<std::size_t>::max() - 1;

  const VideoBytes* bytes_ = nullptr;
  VideoContainer container_ = VideoContainer::none;
  long long max_pixels_ = 0;
  Cursor cursor_;
  AVIOContext* io_ = nullptr;
  AVFormatContext* film_ = nullptr;
  int stream_ = -1;
  const AVCodec* codec_ = nullptr;
  AVPixelFormat format_ = AV_PIX_FMT_NONE;
  VideoFacts facts_;
  std::vector<Shown> shown_;
  std::vector<double> seconds_;
  bool has_own_times_ = true;
  Decoder decoder_;
  Frame frame_{av_frame_alloc()};
  std::size_t next_ = 0;  ///< the number of the frame that the decoder gives next
  bool is_at_end_ = false;
};

std::unique_ptr<VideoReader> reader() { return std::make_unique<FfmpegVideo>(); }

constexpr VideoModule functions{reader};

}  // namespace
}  // namespace vegard::fit

VEGARD_MODULE(&vegard::fit::functions);
