#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

#include "apps/output/animation/movie_writer.h"
#include "sim/base/module.h"

namespace vegard::apps {
namespace {

template <typename Thing, void (*free_it)(Thing**)>
struct FreeBy {
  void operator()(Thing* thing) const { free_it(&thing); }
};
struct FreeFile {
  void operator()(AVFormatContext* film) const {
    avio_closep(&film->pb);
    avformat_free_context(film);
  }
};
struct FreeScaler {
  void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
};
using Packet = std::unique_ptr<AVPacket, FreeBy<AVPacket, av_packet_free>>;
using Frame = std::unique_ptr<AVFrame, FreeBy<AVFrame, av_frame_free>>;
using Encoder = std::unique_ptr<AVCodecContext, FreeBy<AVCodecContext, avcodec_free_context>>;
using Film = std::unique_ptr<AVFormatContext, FreeFile>;
using Scaler = std::unique_ptr<SwsContext, FreeScaler>;

struct Codec {
  MovieKind kind;
  const char *name, *encoder, *container;
  AVPixelFormat pixels;
};
constexpr Codec kCodecs[] = {
    {MovieKind::mp4, "H.264", "libx264", "mp4", AV_PIX_FMT_YUV420P},
    {MovieKind::mp4, "MPEG-4 part 2", "mpeg4", "mp4", AV_PIX_FMT_YUV420P},
    {MovieKind::prores, "ProRes 422 HQ", "prores_ks", "mov", AV_PIX_FMT_YUV422P10LE},
};

/// Reads a picture as 8 or 16 bits per channel, as it is.
cv::Mat picture_of(const std::string& file) {
  return cv::imread(file, cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH);
}

class FfmpegMovie : public MovieWriter {
 public:
  MoviePicture open(const std::string& path, MovieKind kind, const std::string& first,
                    double frames_per_second, double rate_factor) override {
    // Both print of their own accord, about codecs that they do not have and files that they cannot read.
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);  // FFmpeg's AV_LOG_QUIET
    av_log_set_level(AV_LOG_QUIET);
    path_ = path;
    frames_per_second_ = frames_per_second;
    const cv::Mat picture = picture_of(first);
    size_ = picture.size();
    depth_ = picture.depth();
    if (size_.empty()) return MoviePicture::unreadable;
    for (const Codec& codec : kCodecs) {
      if (codec.kind != kind || !begin(codec, rate_factor)) continue;
      codec_ = codec.name;
      break;
    }
    return MoviePicture::good;
  }

  std::string codec() const override { return codec_; }

  MoviePicture write(const std::string& picture) override {
    const cv::Mat read = picture_of(picture);
    if (read.empty()) return MoviePicture::unreadable;
    if (read.size() != size_ || read.depth() != depth_) return MoviePicture::of_other_size;
    const Frame frame(av_frame_alloc());
    frame->format = encoder_->pix_fmt;
    frame->width = size_.width;
    frame->height = size_.height;
    frame->colorspace = encoder_->colorspace;
    frame->pts = number_++;
    if (av_frame_get_buffer(frame.get(), 0) < 0) {
      is_broken_ = true;
      return MoviePicture::good;
    }
    const std::uint8_t* const from[] = {read.data};
    const int stride[] = {static_cast<int>(read.step)};
    sws_scale(scaler_.get(), from, stride, 0, size_.height, frame->data, frame->linesize);
    encode(frame.get());
    return MoviePicture::good;
  }

  void finish() override {
    encode(nullptr);
    if (has_header_) is_broken_ = av_write_trailer(film_.get()) < 0 || is_broken_;
    film_.reset();
  }

  bool is_whole(std::size_t frames) const override {
    cv::VideoCapture movie;
    if (is_broken_ || !movie.open("file:" + path_, cv::CAP_FFMPEG)) return false;
    if (static_cast<int>(movie.get(cv::CAP_PROP_FRAME_WIDTH)) != size_.width) return false;
    if (static_cast<int>(movie.get(cv::CAP_PROP_FRAME_HEIGHT)) != size_.height) return false;
    // A single frame has no rate to be read.
    if (frames > 1 && std::abs(movie.get(cv::CAP_PROP_FPS) - frames_per_second_) >
                          0.002 * std::max(frames_per_second_, 1.0))
      return false;
    std::size_t decoded = 0;
    while (movie.grab()) ++decoded;
    return decoded == frames;
  }

 private:
  bool begin(const Codec& codec, double rate_factor) {
    constexpr int kLongestGroup_s = 2, kThreads = 4, kFinestRate = 100000;
    const AVCodec* const found = avcodec_find_encoder_by_name(codec.encoder);
    if (found == nullptr) return false;
    AVFormatContext* film = nullptr;
    if (avformat_alloc_output_context2(&film, nullptr, codec.container, path_.c_str()) < 0) return false;
    film_.reset(film);
    film_->flags |= AVFMT_FLAG_BITEXACT;
    encoder_.reset(avcodec_alloc_context3(found));
    encoder_->width = size_.width;
    encoder_->height = size_.height;
    encoder_->pix_fmt = codec.pixels;
    encoder_->framerate = av_d2q(frames_per_second_, kFinestRate);
    encoder_->time_base = av_inv_q(encoder_->framerate);
    encoder_->gop_size = std::max(1, static_cast<int>(kLongestGroup_s * frames_per_second_));
    encoder_->thread_count = kThreads;  // the bytes depend on it
    // The numbers of sRGB, by the matrix that decoders assume where they read none.
    encoder_->colorspace = AVCOL_SPC_SMPTE170M;
    encoder_->color_primaries = AVCOL_PRI_BT709;
    encoder_->color_trc = AVCOL_TRC_IEC61966_2_1;
    encoder_->color_range = AVCOL_RANGE_MPEG;
    encoder_->flags |= AV_CODEC_FLAG_BITEXACT;
    if ((film_->oformat->flags & AVFMT_GLOBALHEADER) != 0) encoder_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    if (codec.kind == MovieKind::prores) {
      // The matrix that programs for cutting take for granted; every frame a key frame, as of old.
      encoder_->colorspace = AVCOL_SPC_BT709;
      encoder_->gop_size = 1;
      if (av_opt_set(encoder_->priv_data, "profile", "hq", 0) < 0) return false;
    } else if (av_opt_set_double(encoder_->priv_data, "crf", rate_factor, 0) < 0) {
      // Of MPEG-4: its quantiser, which runs from 1 to 31 where the rate factor runs to 51.
      encoder_->flags |= AV_CODEC_FLAG_QSCALE;
      encoder_->global_quality = FF_QP2LAMBDA * std::max(1, static_cast<int>(std::lround(0.2 * rate_factor)));
    }
    if (avcodec_open2(encoder_.get(), found, nullptr) < 0) return false;
    stream_ = avformat_new_stream(film_.get(), nullptr);
    stream_->time_base = encoder_->time_base;
    stream_->avg_frame_rate = encoder_->framerate;
    if (avcodec_parameters_from_context(stream_->codecpar, encoder_.get()) < 0) return false;
    scaler_.reset(
        sws_getContext(size_.width, size_.height, depth_ == CV_16U ? AV_PIX_FMT_BGR48 : AV_PIX_FMT_BGR24,
                       size_.width, size_.height, encoder_->pix_fmt,
                       SWS_BICUBIC | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INP, nullptr, nullptr, nullptr));
    if (scaler_ == nullptr) return false;
    if (codec.kind == MovieKind::prores)
      sws_setColorspaceDetails(scaler_.get(), sws_getCoefficients(SWS_CS_DEFAULT), 1,
                               sws_getCoefficients(SWS_CS_ITU709), 0, 0, 1 << 16, 1 << 16);
    // A disk that is full at the beginning is noticed as one that is full in the end.
    // A colon in a name is not that of a protocol.
    has_header_ = avio_open(&film_->pb, ("file:" + path_).c_str(), AVIO_FLAG_WRITE) >= 0 &&
                  avformat_write_header(film_.get(), nullptr) >= 0;
    is_broken_ = !has_header_;
    return true;
  }

  /// Encodes a frame, or the end (null), and writes what comes of it.
  void encode(AVFrame* frame) {
    if (is_broken_) return;
    if (frame != nullptr) frame->quality = encoder_->global_quality;
    is_broken_ = avcodec_send_frame(encoder_.get(), frame) < 0;
    const Packet packet(av_packet_alloc());
    while (!is_broken_ && avcodec_receive_packet(encoder_.get(), packet.get()) >= 0) {
      packet->stream_index = stream_->index;
      packet->duration = 1;
      av_packet_rescale_ts(packet.get(), encoder_->time_base, stream_->time_base);
      is_broken_ = av_interleaved_write_frame(film_.get(), packet.get()) < 0;
    }
  }

  std::string path_, codec_;
  double frames_per_second_ = 0.0;
  cv::Size size_;
  int depth_ = CV_8U;
  Film film_;
  Encoder encoder_;
  Scaler scaler_;
  AVStream* stream_ = nullptr;  ///< of film_
  std::int64_t number_ = 0;
  bool has_header_ = false;  ///< without one FFmpeg takes no end
  bool is_broken_ = false;   ///< something could not be encoded or written
};

std::unique_ptr<MovieWriter> writer() { return std::make_unique<FfmpegMovie>(); }

constexpr MovieModule functions{writer};

}  // namespace
}  // namespace vegard::apps

VEGARD_MODULE(&vegard::apps::functions);
