#include "sim/base/picture/fits_io.h"

#include <fitsio.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>

#include "sim/base/error.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/picture/fits_cards.h"
#include "sim/base/picture/fits_checksum.h"
#include "sim/base/picture/fits_header.h"
#include "sim/base/picture/pixel_limit.h"

namespace vegard::sim {
namespace {

constexpr LONGLONG kMaxValues = LONGLONG{1} << 30;  // 4 GiB of floats

std::string words_of(int status) {
  char text[FLEN_STATUS] = {};
  fits_get_errstatus(status, text);
  fits_clear_errmsg();
  return text;
}

struct Close {
  void operator()(fitsfile* file) const {
    int status = 0;
    fits_close_file(file, &status);
    fits_clear_errmsg();
  }
};

/// A FITS file in memory, opened for reading.
class FitsReader {
 public:
  FitsReader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {
    if (bytes.substr(0, 9) != "SIMPLE  =")
      throw unreadable(name, "this is no FITS file")
          .expected("a file that begins with SIMPLE  =")
          .hint("unpack it first if it is compressed");
    if (const std::string fault = fault_of_sizes(bytes); !fault.empty())
      throw unreadable(name, "this FITS file cannot be read: " + fault);
    padded_ = with_cards_in_order(bytes);
    if (!padded_.empty()) bytes = padded_;
    // Some writers leave the last block short, which CFITSIO does not read.
    if (bytes.size() % kFitsBlockBytes != 0) {
      if (padded_.empty()) padded_.assign(bytes);
      padded_.resize((bytes.size() / kFitsBlockBytes + 1) * kFitsBlockBytes, '\0');
      bytes = padded_;
    }
    // Opened for reading only: CFITSIO writes to neither.
    buffer_ = const_cast<char*>(bytes.data());
    buffer_size_ = bytes.size();
    int status = 0;
    fitsfile* file = nullptr;
    fits_open_memfile(&file, "image.fits", READONLY, &buffer_, &buffer_size_, 0, nullptr, &status);
    file_.reset(file);
    check(status);
  }
  FitsReader(const FitsReader&) = delete;
  FitsReader& operator=(const FitsReader&) = delete;

  fitsfile* get() const { return file_.get(); }

  void check(int status) const {
    if (status == 0) return;
    const std::string words = words_of(status);
    if (status == END_OF_FILE || status == READ_ERROR || status == SEEK_ERROR || status == NO_END)
      throw truncated(name_, words);
    throw unreadable(name_, "this FITS file cannot be read: " + words);
  }

  /// Moves on until `wanted` is true of a header's type; false if there is none.
  template <typename Wanted>
  bool find(const Wanted& wanted) const {
    while (true) {
      int status = 0, type = ANY_HDU;
      fits_get_hdu_type(get(), &type, &status);
      check(status);
      if (wanted(type)) return true;
      check_next();
      fits_movrel_hdu(get(), 1, &type, &status);
      if (status == END_OF_FILE) {
        fits_clear_errmsg();
        return false;
      }
      check(status);
    }
  }

  /// Throws unless all data are there that any header promises, and are those that were written.
  void check_whole() const {
    if (const std::string missing = missing_fits_data(bytes_); !missing.empty())
      throw truncated(name_, missing);
    if (const std::string fault = fault_of_fits_sums(bytes_); !fault.empty())
      throw damaged(name_, fault).hint("copy it again; if its data were changed on purpose, take DATASUM out");
  }

  /// Throws unless `size` bytes of data are there behind the header at hand.
  void check_data(LONGLONG size) const {
    int status = 0;
    LONGLONG header = 0, data = 0, end = 0;
    fits_get_hduaddrll(get(), &header, &data, &end, &status);
    check(status);
    if (size > static_cast<LONGLONG>(bytes_.size()) - data)
      throw truncated(name_,
                      "its header promises " + std::to_string(size) + " bytes of data and " +
                          std::to_string(std::max<LONGLONG>(0, static_cast<LONGLONG>(bytes_.size()) - data)) +
                          " are there");
  }

  /// Adds the keywords of the header at hand that are not there yet.
  void add_keywords(FitsKeywords& keywords) const {
    int status = 0, count = 0;
    fits_get_hdrspace(get(), &count, nullptr, &status);
    check(status);
    for (int i = 1; i <= count; ++i) {
      std::array<char, FLEN_CARD> key{}, value{}, comment{};
      fits_read_keyn(get(), i, key.data(), value.data(), comment.data(), &status);
      if (status != 0) {  // one odd line harms no pixel
        status = 0;
        fits_clear_errmsg();
        continue;
      }
      const std::string text = value.data();
      if (key[0] == '\0' || text.empty()) continue;
      keywords.emplace(key.data(), text[0] == '\'' ? unquoted(text) : text);
    }
  }

  /// A keyword's number; `if_absent` if there is none or it is no number.
  double number(const char* key, double if_absent) const {
    int status = 0;
    double value = 0.0;
    fits_read_key(get(), TDOUBLE, key, &value, nullptr, &status);
    if (status == 0 && std::isfinite(value)) return value;
    fits_clear_errmsg();
    return if_absent;
  }

 private:
  /// Looks at the next header before CFITSIO does.
  void check_next() const {
    int status = 0;
    LONGLONG header = 0, data = 0, end = 0;
    fits_get_hduaddrll(get(), &header, &data, &end, &status);
    check(status);
    const auto at = static_cast<std::size_t>(std::max<LONGLONG>(0, end));
    if (at < buffer_size_)
      check_fits_packing({static_cast<const char*>(buffer_) + at, buffer_size_ - at}, name_);
  }

  static std::string unquoted(const std::string& text) {
    std::string plain;
    for (std::size_t i = 1; i < text.size(); ++i) {
      if (text[i] == '\'') {
        if (i + 1 >= text.size() || text[i + 1] != '\'') break;
        ++i;
      }
      plain += text[i];
    }
    plain.erase(plain.find_last_not_of(' ') + 1);
    return plain;
  }

  std::string_view bytes_;
  std::string name_, padded_;
  void* buffer_ = nullptr;
  std::size_t buffer_size_ = 0;
  std::unique_ptr<fitsfile, Close> file_;
};

std::vector<std::string> plane_names(int planes) {
  if (planes == 1) return {"Y"};
  if (planes == 3) return {"R", "G", "B"};
  std::vector<std::string> names;
  for (int p = 1; p <= planes; ++p) names.push_back(std::to_string(p));
  return names;
}

struct Shape {
  LONGLONG width = 0, height = 0, planes = 1;
};

Shape shape_of(const FitsReader& reader, const std::string& name) {
  constexpr int kMaxAxes = 9;
  int status = 0, axes = 0;
  std::array<LONGLONG, kMaxAxes> length{};
  fits_get_img_dim(reader.get(), &axes, &status);
  fits_get_img_sizell(reader.get(), kMaxAxes, length.data(), &status);
  reader.check(status);
  for (int a = 3; a < axes; ++a)
    if (a >= kMaxAxes || length[a] != 1)
      throw unreadable(name, "an image of " + std::to_string(axes) + " axes is not read")
          .expected("two axes, or planes along a third");
  Shape shape{length[0], length[1], axes >= 3 ? length[2] : 1};
  check_pixel_limit(shape.width, shape.height, name);
  if (shape.planes < 1 || shape.planes > kMaxValues / (shape.width * shape.height))
    throw unreadable(name, "the image claims " + std::to_string(shape.planes) + " planes of " +
                               std::to_string(shape.width) + " x " + std::to_string(shape.height) + " pixels")
        .expected("at most 2^30 numbers in all");
  return shape;
}

void describe_numbers(const FitsReader& reader, FitsImage& file) {
  int status = 0, type = 0;
  fits_get_img_type(reader.get(), &type, &status);
  reader.check(status);
  file.bits = std::abs(type);
  file.floating = type < 0;
  if (file.floating) return;
  const double zero = reader.number("BZERO", 0.0), scale = reader.number("BSCALE", 1.0);
  // Bytes are stored unsigned, all others signed.
  const double most = type == BYTE_IMG ? 255.0 : std::ldexp(1.0, file.bits - 1) - 1.0;
  const double least = type == BYTE_IMG ? 0.0 : -std::ldexp(1.0, file.bits - 1);
  file.largest = zero + scale * (scale > 0.0 ? most : least);
  file.step = std::abs(scale);
}

void read_values(const FitsReader& reader, const Shape& shape, bool top_down, FitsImage& file) {
  const int width = file.image.width, height = file.image.height, planes = file.image.channels();
  std::vector<double> row(width);
  // NaN in the place of BLANK. Flags beside the numbers (fits_read_imgnull) end the process where packed
  // tiles are more than a row high: CFITSIO 4.2 copies the flags of a tile that it has kept from no address
  // at all.
  double unknown = std::numeric_limits<double>::quiet_NaN();
  for (int p = 0; p < planes; ++p) {
    for (int stored = 0; stored < height; ++stored) {
      int status = 0, any = 0;
      const LONGLONG first = (static_cast<LONGLONG>(p) * shape.height + stored) * shape.width + 1;
      fits_read_img(reader.get(), TDOUBLE, first, width, &unknown, row.data(), &any, &status);
      reader.check(status);
      const int y = top_down ? stored : height - 1 - stored;
      for (int x = 0; x < width; ++x) {
        const float value = static_cast<float>(row[x]);
        const std::size_t i = file.image.index(x, y, p);
        file.known[i] = std::isfinite(value);
        file.image.data[i] = file.known[i] ? value : 0.0f;
      }
    }
  }
}

void write_rows(fitsfile* file, const Image& image, int* status) {
  std::vector<float> row(image.width);
  LONGLONG first = 1;
  for (int c = 0; c < image.channels(); ++c)
    for (int y = image.height - 1; y >= 0; --y, first += image.width) {
      for (int x = 0; x < image.width; ++x) row[x] = image.at(x, y, c);
      fits_write_img(file, TFLOAT, first, image.width, row.data(), status);
    }
}

void write_keywords(fitsfile* file, const std::vector<FitsKeyword>& keywords, int* status) {
  for (const FitsKeyword& keyword : keywords) {
    constexpr int kAllDigits = -17;
    if (const auto* number = std::get_if<double>(&keyword.value))
      fits_write_key_dbl(file, keyword.name.c_str(), *number, kAllDigits, keyword.comment.c_str(), status);
    else
      fits_write_key_longstr(file, keyword.name.c_str(), std::get<std::string>(keyword.value).c_str(),
                             keyword.comment.c_str(), status);
  }
}

/// The bytes of a file in memory that `fill` writes. Throws Error(unwritable_output) about `name`.
template <typename Fill>
std::string encoded_in_memory(const std::string& name, const Fill& fill) {
  void* buffer = nullptr;
  std::size_t size = 0;
  int status = 0;
  fitsfile* raw = nullptr;
  fits_create_memfile(&raw, &buffer, &size, kFitsBlockBytes * 64, std::realloc, &status);
  std::string bytes;
  if (status == 0) {
    const std::unique_ptr<fitsfile, Close> file(raw);
    fill(raw, &status);
    fits_flush_file(raw, &status);
    LONGLONG header = 0, data = 0, end = 0;
    fits_get_hduaddrll(raw, &header, &data, &end, &status);
    if (status == 0) bytes.assign(static_cast<const char*>(buffer), static_cast<std::size_t>(end));
  }
  std::free(buffer);
  if (status != 0)
    throw Error(ErrorKind::unwritable_output, "cannot be encoded: " + words_of(status)).file(name);
  return with_fits_checksums(bytes);
}

}  // namespace

FitsImage read_fits_image(std::string_view bytes, const std::string& name) {
  const FitsReader reader(bytes, name);
  FitsImage file;
  FitsKeywords first_keywords;
  reader.add_keywords(first_keywords);
  const bool found = reader.find([&](int type) {
    int status = 0, axes = 0;
    if (type == BINARY_TBL && !fits_is_compressed_image(reader.get(), &status)) return false;
    if (type == ASCII_TBL) return false;
    fits_get_img_dim(reader.get(), &axes, &status);
    reader.check(status);
    return axes >= 2;
  });
  if (!found) throw unreadable(name, "there is no image in this FITS file").expected("two axes");
  reader.add_keywords(file.keywords);
  int status = 0;
  const bool compressed = fits_is_compressed_image(reader.get(), &status) != 0;
  const Shape shape = shape_of(reader, name);
  describe_numbers(reader, file);
  if (!compressed) reader.check_data(shape.width * shape.height * shape.planes * (file.bits / 8));
  reader.check_whole();
  file.keywords.insert(first_keywords.begin(), first_keywords.end());
  try {
    file.image = Image(static_cast<int>(shape.width), static_cast<int>(shape.height),
                       plane_names(static_cast<int>(shape.planes)));
    file.known.assign(file.image.data.size(), 0);
  } catch (const std::bad_alloc&) {
    throw unreadable(name, "there is not enough memory for its image");
  }
  const auto order = file.keywords.find("ROWORDER");
  read_values(reader, shape, order != file.keywords.end() && order->second == "TOP-DOWN", file);
  return file;
}

FitsTable read_fits_table(std::string_view bytes, const std::string& name) {
  const FitsReader reader(bytes, name);
  FitsTable table;
  const bool found = reader.find([&](int type) {
    int status = 0;
    return type == BINARY_TBL && !fits_is_compressed_image(reader.get(), &status);
  });
  if (!found) throw unreadable(name, "there is no binary table in this FITS file");
  reader.add_keywords(table.keywords);
  int status = 0, columns = 0;
  LONGLONG rows = 0;
  fits_get_num_rowsll(reader.get(), &rows, &status);
  fits_get_num_cols(reader.get(), &columns, &status);
  reader.check(status);
  const auto row_bytes = static_cast<LONGLONG>(reader.number("NAXIS1", 0.0));
  if (rows < 0 || row_bytes < 1 || rows > std::numeric_limits<LONGLONG>::max() / row_bytes)
    throw unreadable(name, "the table in this FITS file has an impossible size");
  reader.check_data(row_bytes * rows);
  reader.check_whole();
  for (int c = 1; c <= columns; ++c) {
    int type = 0;
    LONGLONG repeat = 0, width = 0;
    fits_get_coltypell(reader.get(), c, &type, &repeat, &width, &status);
    std::array<char, FLEN_VALUE> column_name{};
    const std::string key = "TTYPE" + std::to_string(c);
    reader.check(status);
    fits_read_key(reader.get(), TSTRING, key.c_str(), column_name.data(), nullptr, &status);
    status = 0;
    const bool number = type > 0 && type != TSTRING && type != TBIT && type != TLOGICAL && type != TCOMPLEX &&
                        type != TDBLCOMPLEX;
    if (!number || repeat != 1) continue;
    std::vector<double> values(static_cast<std::size_t>(rows));
    double unknown = std::numeric_limits<double>::quiet_NaN();
    int any = 0;
    if (rows > 0) fits_read_col(reader.get(), TDOUBLE, c, 1, 1, rows, &unknown, values.data(), &any, &status);
    reader.check(status);
    table.columns.emplace(column_name[0] ? column_name.data() : std::to_string(c), std::move(values));
  }
  return table;
}

FitsKeywords read_fits_header(std::string_view bytes, const std::string& name) {
  FitsKeywords keywords;
  FitsReader(bytes, name).add_keywords(keywords);
  return keywords;
}

std::string encode_fits(const Image& image, const std::vector<FitsKeyword>& keywords,
                        const std::string& name) {
  assert(!image.empty());
  return encoded_in_memory(name, [&](fitsfile* file, int* status) {
    LONGLONG lengths[3] = {image.width, image.height, image.channels()};
    fits_create_imgll(file, FLOAT_IMG, image.channels() == 1 ? 2 : 3, lengths, status);
    fits_write_key_str(file, "ROWORDER", "BOTTOM-UP", "the lowest row comes first", status);
    write_keywords(file, keywords, status);
    write_rows(file, image, status);
  });
}

std::string encode_fits_header(const std::vector<FitsKeyword>& keywords, const std::string& name) {
  return encoded_in_memory(name, [&](fitsfile* file, int* status) {
    fits_create_imgll(file, BYTE_IMG, 0, nullptr, status);
    write_keywords(file, keywords, status);
  });
}

std::string encode_fits_table(const std::vector<FitsColumn>& columns,
                              const std::vector<FitsKeyword>& keywords, const std::string& name) {
  assert(!columns.empty());
  return encoded_in_memory(name, [&](fitsfile* file, int* status) {
    fits_create_imgll(file, BYTE_IMG, 0, nullptr, status);
    write_keywords(file, keywords, status);
    std::vector<char*> names, forms, units;
    std::string form = "D";
    for (const FitsColumn& column : columns) {
      // CFITSIO reads all three, and takes them for its own only by their types.
      names.push_back(const_cast<char*>(column.name.c_str()));
      forms.push_back(form.data());
      units.push_back(const_cast<char*>(column.unit.c_str()));
    }
    const auto rows = static_cast<LONGLONG>(columns.front().values.size());
    fits_create_tbl(file, BINARY_TBL, rows, static_cast<int>(columns.size()), names.data(), forms.data(),
                    units.data(), nullptr, status);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      std::vector<double> values = columns[c].values;
      if (!values.empty())
        fits_write_col(file, TDOUBLE, static_cast<int>(c) + 1, 1, 1, rows, values.data(), status);
    }
  });
}

void write_fits(const std::string& path, const Image& image, const std::vector<FitsKeyword>& keywords,
                bool overwrite) {
  WholeFile file(path, overwrite);
  file.write(encode_fits(image, keywords, path));
  file.commit();
}

std::string fits_library_version() {
  return std::to_string(CFITSIO_MAJOR) + "." + std::to_string(CFITSIO_MINOR) + "." +
         std::to_string(CFITSIO_MICRO);
}

}  // namespace vegard::sim
