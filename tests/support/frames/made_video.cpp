#include "tests/support/frames/made_video.h"

#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/display.h>
#include <libavutil/pixdesc.h>
}

namespace vegard::tests {
namespace {

void good(int result, const char* what) {
  if (result < 0) throw std::runtime_error(std::string("no ") + what);
}

/// Encodes a frame, or the end, and writes what comes of it.
void encode(AVCodecContext* encoder, AVFrame* frame, AVFormatContext* film, AVStream* stream) {
  good(avcodec_send_frame(encoder, frame), "frame");
  AVPacket* packet = av_packet_alloc();
  while (avcodec_receive_packet(encoder, packet) >= 0) {
    av_packet_rescale_ts(packet, encoder->time_base, stream->time_base);
    packet->stream_index = stream->index;
    good(av_interleaved_write_frame(film, packet), "packet");
  }
  av_packet_free(&packet);
}

AVCodecContext* sound_encoder(AVFormatContext* film, AVStream*& stream) {
  const AVCodec* const codec = avcodec_find_encoder_by_name("pcm_s16le");
  AVCodecContext* encoder = avcodec_alloc_context3(codec);
  encoder->sample_fmt = AV_SAMPLE_FMT_S16;
  encoder->sample_rate = 8000;
  av_channel_layout_default(&encoder->ch_layout, 1);
  encoder->time_base = {1, 8000};
  good(avcodec_open2(encoder, codec, nullptr), "sound");
  stream = avformat_new_stream(film, nullptr);
  avcodec_parameters_from_context(stream->codecpar, encoder);
  return encoder;
}

void add_sound(AVCodecContext* encoder, AVFormatContext* film, AVStream* stream) {
  AVFrame* frame = av_frame_alloc();
  frame->nb_samples = 4000;
  frame->format = AV_SAMPLE_FMT_S16;
  frame->sample_rate = 8000;
  av_channel_layout_copy(&frame->ch_layout, &encoder->ch_layout);
  good(av_frame_get_buffer(frame, 0), "room");
  std::memset(frame->data[0], 0, 2 * static_cast<std::size_t>(frame->nb_samples));
  frame->pts = 0;
  encode(encoder, frame, film, stream);
  encode(encoder, nullptr, film, stream);
  av_frame_free(&frame);
}

AVCodecContext* picture_encoder(const MadeVideo& made, AVFormatContext* film, AVStream*& stream) {
  const AVCodec* const codec = avcodec_find_encoder_by_name(made.encoder.c_str());
  AVCodecContext* encoder = avcodec_alloc_context3(codec);
  encoder->width = made.width_px;
  encoder->height = made.height_px;
  encoder->pix_fmt = av_get_pix_fmt(made.pixels.c_str());
  encoder->time_base = {1, 1000};
  encoder->framerate = {25, 1};
  encoder->gop_size = 4;
  encoder->thread_count = 1;
  encoder->global_quality = 2 * FF_QP2LAMBDA;
  encoder->flags |= AV_CODEC_FLAG_QSCALE | AV_CODEC_FLAG_BITEXACT;
  encoder->color_trc = static_cast<AVColorTransferCharacteristic>(made.transfer);
  encoder->color_primaries = static_cast<AVColorPrimaries>(made.primaries);
  encoder->colorspace = static_cast<AVColorSpace>(made.matrix);
  if (made.says_full_range) encoder->color_range = AVCOL_RANGE_JPEG;
  encoder->sample_aspect_ratio = {made.pixel_aspect[0], made.pixel_aspect[1]};
  if ((film->oformat->flags & AVFMT_GLOBALHEADER) != 0) encoder->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  AVDictionary* options = nullptr;
  for (const auto& [key, value] : made.options) av_dict_set(&options, key.c_str(), value.c_str(), 0);
  good(avcodec_open2(encoder, codec, &options), "encoder");
  av_dict_free(&options);
  stream = avformat_new_stream(film, nullptr);
  avcodec_parameters_from_context(stream->codecpar, encoder);
  // AVI has one rate, and a chunk for every frame that is missing at it.
  stream->time_base = made.container == "avi" ? AVRational{1, 25} : AVRational{1, 1000};
  stream->avg_frame_rate = {25, 1};
  stream->sample_aspect_ratio = encoder->sample_aspect_ratio;
  if (made.quarter_turns != 0) {
    auto* const matrix = reinterpret_cast<std::int32_t*>(
        av_stream_new_side_data(stream, AV_PKT_DATA_DISPLAYMATRIX, 9 * sizeof(std::int32_t)));
    av_display_rotation_set(matrix, 90.0 * made.quarter_turns);  // clockwise, as this function counts
  }
  return encoder;
}

void add_frames(const MadeVideo& made, AVCodecContext* encoder, AVFormatContext* film, AVStream* stream) {
  const AVPixFmtDescriptor& kind = *av_pix_fmt_desc_get(encoder->pix_fmt);
  for (std::size_t i = 0; i < made.times_ms.size(); ++i) {
    AVFrame* frame = av_frame_alloc();
    frame->format = encoder->pix_fmt;
    frame->width = made.width_px;
    frame->height = made.height_px;
    good(av_frame_get_buffer(frame, 0), "room");
    const std::array<int, 3> codes = made.codes(static_cast<int>(i));
    for (int plane = 0; plane < kind.nb_components; ++plane) {
      const int high = plane == 0 ? made.height_px : AV_CEIL_RSHIFT(made.height_px, kind.log2_chroma_h);
      const bool is_wide = kind.comp[plane].depth > 8;
      for (int y = 0; y < high; ++y) {
        std::uint8_t* const row =
            frame->data[plane] + static_cast<std::ptrdiff_t>(y) * frame->linesize[plane];
        const int wide = plane == 0 ? made.width_px : AV_CEIL_RSHIFT(made.width_px, kind.log2_chroma_w);
        for (int x = 0; x < wide; ++x) {
          row[is_wide ? 2 * x : x] = static_cast<std::uint8_t>(codes[plane] & 0xff);
          if (is_wide) row[2 * x + 1] = static_cast<std::uint8_t>(codes[plane] >> 8);
        }
        // A mark in the upper left, by which a turn is seen.
        if (plane == 0 && !is_wide && y < made.height_px / 2)
          for (int x = 0; x < wide / 2; ++x) row[x] = static_cast<std::uint8_t>(codes[plane] + 20);
      }
    }
    frame->pts = made.times_ms[i];
    frame->quality = encoder->global_quality;
    encode(encoder, frame, film, stream);
    av_frame_free(&frame);
  }
  encode(encoder, nullptr, film, stream);
}

}  // namespace

bool is_encoder_there(const std::string& encoder) {
  return avcodec_find_encoder_by_name(encoder.c_str()) != nullptr;
}

std::string video_bytes(const MadeVideo& made) {
  av_log_set_level(AV_LOG_QUIET);
  AVFormatContext* film = nullptr;
  good(avformat_alloc_output_context2(&film, nullptr, made.container.c_str(), nullptr), "container");
  film->flags |= AVFMT_FLAG_BITEXACT;
  for (const auto& [key, value] : made.words) av_dict_set(&film->metadata, key.c_str(), value.c_str(), 0);
  AVStream *pictures = nullptr, *sound = nullptr;
  AVCodecContext* encoder = made.codes ? picture_encoder(made, film, pictures) : nullptr;
  AVCodecContext* recorder = made.has_sound ? sound_encoder(film, sound) : nullptr;
  static int films = 0;
  const std::string file = std::filesystem::temp_directory_path() /
                           ("vegard-film-" + std::to_string(::getpid()) + "-" + std::to_string(films++));
  good(avio_open(&film->pb, file.c_str(), AVIO_FLAG_WRITE), "file");
  AVDictionary* options = nullptr;
  if (made.container == "mov") av_dict_set(&options, "movflags", "use_metadata_tags", 0);
  good(avformat_write_header(film, &options), "header");
  av_dict_free(&options);
  if (recorder != nullptr) add_sound(recorder, film, sound);
  if (encoder != nullptr) add_frames(made, encoder, film, pictures);
  good(av_write_trailer(film), "trailer");
  avio_closep(&film->pb);
  std::ifstream stream(file, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  std::filesystem::remove(file);
  avcodec_free_context(&encoder);
  avcodec_free_context(&recorder);
  avformat_free_context(film);
  return bytes;
}

}  // namespace vegard::tests
