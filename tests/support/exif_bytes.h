// EXIF data made byte by byte: three directories of tags, in either byte order.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/image_bytes.h"

namespace vegard::tests {

class ExifMaker {
 public:
  explicit ExifMaker(bool big_endian = false) : big_(big_endian) {}

  enum Directory { kImage = 0, kExif = 1, kGps = 2 };

  ExifMaker& text(Directory in, int tag, const std::string& value) {
    return add(in, tag, 2, value.size() + 1, value + '\0');
  }
  ExifMaker& shorts(Directory in, int tag, const std::vector<int>& values) {
    std::string data;
    for (const int value : values) data += number(value, 2);
    return add(in, tag, 3, values.size(), data);
  }
  ExifMaker& longs(Directory in, int tag, const std::vector<int>& values) {
    std::string data;
    for (const int value : values) data += number(value, 4);
    return add(in, tag, 4, values.size(), data);
  }
  ExifMaker& byte(Directory in, int tag, int value) {
    return add(in, tag, 1, 1, std::string(1, static_cast<char>(value)));
  }
  ExifMaker& fractions(Directory in, int tag,
                       const std::vector<std::pair<std::uint32_t, std::uint32_t>>& values) {
    std::string data;
    for (const auto& [above, below] : values) data += number(above, 4) + number(below, 4);
    return add(in, tag, 5, values.size(), data);
  }
  /// An entry as it is, whatever it says.
  ExifMaker& add(Directory in, int tag, int type, std::uint64_t count, const std::string& data) {
    entries_[in].push_back({tag, type, count, data});
    return *this;
  }

  std::string bytes() const {
    std::string tiff = (big_ ? "MM" : "II") + number(42, 2) + number(8, 4);
    // The first directory with its data, then the two that it points to.
    std::vector<Entry> image = entries_[kImage];
    constexpr int kPointers[] = {0, 34665, 34853};
    for (const int which : {kExif, kGps})
      if (!entries_[which].empty()) image.push_back({kPointers[which], 4, 1, number(0, 4)});
    std::size_t next = 8 + size_of(image);
    for (Entry& entry : image)
      for (const int which : {kExif, kGps})
        if (entry.tag == kPointers[which] && !entries_[which].empty()) {
          entry.data = number(next, 4);
          next += size_of(entries_[which]);
        }
    tiff += directory(image, tiff.size());
    for (const int which : {kExif, kGps})
      if (!entries_[which].empty()) tiff += directory(entries_[which], tiff.size());
    return tiff;
  }

 private:
  struct Entry {
    int tag, type;
    std::uint64_t count;
    std::string data;
  };

  std::string number(std::uint64_t value, int size) const {
    return big_ ? big_endian(value, size) : little_endian(value, size);
  }

  static std::size_t size_of(const std::vector<Entry>& entries) {
    std::size_t size = 2 + 12 * entries.size() + 4;
    for (const Entry& entry : entries)
      if (entry.data.size() > 4) size += entry.data.size();
    return size;
  }

  std::string directory(const std::vector<Entry>& entries, std::size_t at) const {
    std::string head = number(entries.size(), 2), data;
    const std::size_t data_at = at + 2 + 12 * entries.size() + 4;
    for (const Entry& entry : entries) {
      head += number(entry.tag, 2) + number(entry.type, 2) + number(entry.count, 4);
      if (entry.data.size() > 4) {
        head += number(data_at + data.size(), 4);
        data += entry.data;
      } else {
        head += entry.data + std::string(4 - entry.data.size(), '\0');
      }
    }
    return head + number(0, 4) + data;
  }

  bool big_;
  std::vector<Entry> entries_[3];
};

/// What a phone writes of a picture in the north of Canada; 4000 x 3000 pixels.
inline ExifMaker phone_exif(bool big_endian = false) {
  using M = ExifMaker;
  ExifMaker maker(big_endian);
  maker.text(M::kImage, 271, "MAKER").text(M::kImage, 272, "PHONE 1").shorts(M::kImage, 274, {1});
  maker.fractions(M::kExif, 33434, {{15, 2}}).fractions(M::kExif, 33437, {{18, 10}});
  maker.shorts(M::kExif, 34855, {1600}).text(M::kExif, 36867, "2019:03:01 00:16:30");
  maker.text(M::kExif, 36881, "-07:00").fractions(M::kExif, 37386, {{395, 100}});
  maker.text(M::kExif, 37521, "92").longs(M::kExif, 40962, {4000}).longs(M::kExif, 40963, {3000});
  maker.shorts(M::kExif, 41989, {27}).text(M::kExif, 42036, "LENS 3.95mm");
  maker.text(M::kGps, 1, "N").fractions(M::kGps, 2, {{62, 1}, {24, 1}, {585764, 10000}});
  maker.text(M::kGps, 3, "W").fractions(M::kGps, 4, {{114, 1}, {17, 1}, {201855, 10000}});
  maker.byte(M::kGps, 5, 0).fractions(M::kGps, 6, {{16986, 100}});
  maker.fractions(M::kGps, 7, {{7, 1}, {16, 1}, {1, 1}}).text(M::kGps, 29, "2019:03:01");
  return maker;
}

/// A JPEG of 8 x 8 blocks with these EXIF data in it.
inline std::string jpeg_with_exif(int columns, int rows, const std::string& exif) {
  return with_app1(jpeg_of_blocks(columns, rows, std::vector<int>(columns * rows, 90)),
                   std::string("Exif\0\0", 6) + exif);
}

/// A HEIC without a picture: the boxes on the way to its EXIF data, and these.
inline std::string heic_with_exif(const std::string& exif) {
  const auto box = [](const std::string& type, const std::string& inside) {
    return big_endian(inside.size() + 8, 4) + type + inside;
  };
  const std::string start = box("ftyp", std::string("heic") + std::string(4, '\0') + "heic");
  const std::string entry =
      box("infe", big_endian(2u << 24, 4) + big_endian(7, 2) + big_endian(0, 2) + "Exif" + '\0');
  const std::string information = box("iinf", big_endian(0, 4) + big_endian(1, 2) + entry);
  const std::string payload = big_endian(6, 4) + std::string("Exif\0\0", 6) + exif;
  const auto meta = [&](std::size_t at) {
    const std::string location = big_endian(0, 4) + big_endian(0x4400, 2) + big_endian(1, 2) +
                                 big_endian(7, 2) + big_endian(0, 2) + big_endian(1, 2) + big_endian(at, 4) +
                                 big_endian(payload.size(), 4);
    return box("meta", big_endian(0, 4) + information + box("iloc", location));
  };
  return start + meta(start.size() + meta(0).size() + 8) + box("mdat", payload);
}

}  // namespace vegard::tests
