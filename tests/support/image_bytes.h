// Image files made byte by byte, so that a test knows every one of them and can spoil any.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace vegard::tests {

inline std::string big_endian(std::uint64_t value, int size) {
  std::string s;
  for (int shift = 8 * (size - 1); shift >= 0; shift -= 8) s += static_cast<char>(value >> shift & 0xff);
  return s;
}

inline std::string little_endian(std::uint64_t value, int size) {
  std::string s;
  for (int i = 0; i < size; ++i) s += static_cast<char>(value >> 8 * i & 0xff);
  return s;
}

/// A file among the system's temporary ones, removed with this object.
class TemporaryFile {
 public:
  /// Tests run side by side in processes of their own.
  TemporaryFile(const std::string& name, const std::string& bytes)
      : path_(std::filesystem::temp_directory_path() / ("vegard-" + std::to_string(getpid()) + "-" + name)) {
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  std::string path() const { return path_.string(); }
  std::string name() const { return path_.filename().string(); }

 private:
  std::filesystem::path path_;
};

// ---- JPEG ----

/// A grey baseline JPEG of flat 8 x 8 blocks, row by row, which decodes to exactly these levels: only the
/// constant term of each block is there, and a quantiser of 8 makes one code of it one level.
inline std::string jpeg_of_blocks(int columns, int rows, const std::vector<int>& levels) {
  auto segment = [](int marker, const std::string& body) {
    return std::string{'\xff', static_cast<char>(marker)} + big_endian(body.size() + 2, 2) + body;
  };
  std::string jpeg = "\xff\xd8";
  jpeg += segment(0xdb, std::string(1, '\0') + std::string(64, '\x08'));
  jpeg += segment(0xc0, big_endian(8, 1) + big_endian(8 * rows, 2) + big_endian(8 * columns, 2) +
                            std::string("\x01\x01\x11\x00", 4));
  // Constant terms: twelve categories with codes of four bits, 0 to 11. The others: end of block alone, one
  // bit.
  std::string lengths(16, '\0'), symbols;
  lengths[3] = 12;
  for (int i = 0; i < 12; ++i) symbols += static_cast<char>(i);
  jpeg += segment(0xc4, std::string(1, '\x00') + lengths + symbols);
  lengths.assign(16, '\0');
  lengths[0] = 1;
  jpeg += segment(0xc4, std::string(1, '\x10') + lengths + std::string(1, '\0'));
  jpeg += segment(0xda, std::string("\x01\x01\x00\x00\x3f\x00", 6));
  std::string bits;
  auto put = [&bits](int value, int count) {
    for (int k = count - 1; k >= 0; --k) bits += (value >> k & 1) ? '1' : '0';
  };
  int last = 0;
  for (const int level : levels) {
    const int difference = level - 128 - last;
    last = level - 128;
    int category = 0;
    while (std::abs(difference) >> category) ++category;
    put(category, 4);
    put(difference < 0 ? difference + (1 << category) - 1 : difference, category);
    put(0, 1);
  }
  while (bits.size() % 8) bits += '1';
  for (std::size_t i = 0; i < bits.size(); i += 8) {
    jpeg += static_cast<char>(std::stoi(bits.substr(i, 8), nullptr, 2));
    if (jpeg.back() == '\xff') jpeg += '\0';
  }
  return jpeg + "\xff\xd9";
}

/// EXIF data with nothing but an orientation, in either byte order.
inline std::string exif_with_orientation(int orientation, bool big) {
  auto number = [big](std::uint64_t v, int size) {
    return big ? big_endian(v, size) : little_endian(v, size);
  };
  return (big ? "MM" : "II") + number(42, 2) + number(8, 4) + number(1, 2) + number(274, 2) + number(3, 2) +
         number(1, 4) + number(orientation, 2) + number(0, 2) + number(0, 4);
}

/// The JPEG with an APP1 segment spliced in right after its start.
inline std::string with_app1(const std::string& jpeg, const std::string& body) {
  return jpeg.substr(0, 2) + "\xff\xe1" + big_endian(body.size() + 2, 2) + body + jpeg.substr(2);
}

// ---- PNG ----

inline std::string png_chunk(const std::string& type, const std::string& data) {
  std::uint32_t crc = 0xffffffffu;
  for (const char byte : type + data) {
    crc ^= static_cast<unsigned char>(byte);
    for (int k = 0; k < 8; ++k) crc = (crc & 1) ? 0xedb88320u ^ crc >> 1 : crc >> 1;
  }
  return big_endian(data.size(), 4) + type + data + big_endian(crc ^ 0xffffffffu, 4);
}

/// Channels 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA; samples row by row, interleaved. `more` are chunks that
/// go before the picture.
inline std::string png(int width, int height, int channels, int bits, const std::vector<int>& samples,
                       const std::string& more = {}) {
  const int colour_type = channels == 1 ? 0 : channels == 2 ? 4 : channels == 3 ? 2 : 6;
  std::string raw;
  for (int y = 0; y < height; ++y) {
    raw += '\0';
    for (int i = 0; i < width * channels; ++i)
      raw += big_endian(samples.at(y * width * channels + i), bits / 8);
  }
  std::uint32_t a = 1, b = 0;
  for (const char byte : raw) {
    a = (a + static_cast<unsigned char>(byte)) % 65521;
    b = (b + a) % 65521;
  }
  const std::string zlib = std::string("\x78\x01\x01", 3) + little_endian(raw.size(), 2) +
                           little_endian(~raw.size() & 0xffff, 2) + raw + big_endian(b << 16 | a, 4);
  return "\x89PNG\r\n\x1a\n" +
         png_chunk("IHDR", big_endian(width, 4) + big_endian(height, 4) + big_endian(bits, 1) +
                               big_endian(colour_type, 1) + std::string(3, '\0')) +
         more + png_chunk("IDAT", zlib) + png_chunk("IEND", "");
}

// ---- TIFF ----

struct Tiff {
  int width = 0, height = 0, channels = 3, bits = 8;
  bool floating = false;
  int orientation = 1;
  int photometric = 2;    ///< 2 RGB, 1 grey
  int planar = 1;         ///< 1 interleaved
  int extra_samples = 2;  ///< what a fourth channel is: 2 unassociated alpha
};

/// One strip, not compressed, little-endian; float samples are given as their values.
inline std::string tiff(const Tiff& t, const std::vector<double>& samples) {
  std::string pixels;
  for (const double sample : samples) {
    if (t.floating) {
      const float value = static_cast<float>(sample);
      std::uint32_t word;
      std::memcpy(&word, &value, 4);
      pixels += little_endian(word, 4);
    } else {
      pixels += little_endian(static_cast<std::uint64_t>(sample), t.bits / 8);
    }
  }
  constexpr int kEntries = 13;
  const int lists = 8 + 2 + 12 * kEntries + 4;
  const int list_size = 2 * t.channels;
  std::string bits_list, format_list;
  for (int c = 0; c < t.channels; ++c) {
    bits_list += little_endian(t.bits, 2);
    format_list += little_endian(t.floating ? 3 : 1, 2);
  }
  auto entry = [](int tag, int type, int count, int value) {
    return little_endian(tag, 2) + little_endian(type, 2) + little_endian(count, 4) + little_endian(value, 4);
  };
  auto list_entry = [&](int tag, int at, int single) {
    return t.channels > 2 ? entry(tag, 3, t.channels, at) : entry(tag, 3, 1, single);
  };
  const int data = lists + 2 * list_size;
  std::string s = "II" + little_endian(42, 2) + little_endian(8, 4) + little_endian(kEntries, 2);
  s += entry(256, 4, 1, t.width) + entry(257, 4, 1, t.height) + list_entry(258, lists, t.bits);
  s += entry(259, 3, 1, 1) + entry(262, 3, 1, t.photometric) + entry(273, 4, 1, data);
  s += entry(274, 3, 1, t.orientation) + entry(277, 3, 1, t.channels) + entry(278, 4, 1, t.height);
  s += entry(279, 4, 1, static_cast<int>(pixels.size())) + entry(284, 3, 1, t.planar);
  s += t.channels == 4 ? entry(338, 3, 1, t.extra_samples) : entry(338, 3, 0, 0);
  s += list_entry(339, lists + list_size, t.floating ? 3 : 1) + little_endian(0, 4);
  return s + bits_list + format_list + pixels;
}

}  // namespace vegard::tests
