// FITS files made card by card, so that a test knows every byte and can tell any lie.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace vegard::tests {

/// "BITPIX  =                   16", 80 characters.
inline std::string fits_card(const std::string& key, const std::string& value) {
  std::string card = key;
  card.resize(8, ' ');
  card += "= ";
  if (value[0] != '\'') card.append(value.size() < 20 ? 20 - value.size() : 0, ' ');
  card += value;
  card.resize(80, ' ');
  return card;
}

inline std::string fits_block(std::string text, char filling) {
  text.resize((text.size() + 2879) / 2880 * 2880, filling);
  return text;
}

/// A first header with these axes and further cards.
inline std::string fits_header(int bitpix, const std::vector<long long>& axes, const std::string& more = {}) {
  std::string cards = fits_card("SIMPLE", "T") + fits_card("BITPIX", std::to_string(bitpix)) +
                      fits_card("NAXIS", std::to_string(axes.size()));
  for (std::size_t i = 0; i < axes.size(); ++i)
    cards += fits_card("NAXIS" + std::to_string(i + 1), std::to_string(axes[i]));
  cards += more + "END";
  return fits_block(cards, ' ');
}

/// Numbers as FITS stores them: two's complement or IEEE 754, the highest byte first.
inline std::string fits_numbers(int bitpix, const std::vector<double>& values) {
  std::string data;
  for (const double value : values) {
    std::uint64_t word = 0;
    if (bitpix == -64) {
      std::memcpy(&word, &value, 8);
    } else if (bitpix == -32) {
      const float single = static_cast<float>(value);
      std::uint32_t half = 0;
      std::memcpy(&half, &single, 4);
      word = half;
    } else {
      word = static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
    }
    for (int shift = (bitpix < 0 ? -bitpix : bitpix) - 8; shift >= 0; shift -= 8)
      data += static_cast<char>(word >> shift & 0xff);
  }
  return data;
}

/// A whole image; the rows of `values` in the file's order.
inline std::string fits_image(int bitpix, const std::vector<long long>& axes,
                              const std::vector<double>& values, const std::string& more = {}) {
  return fits_header(bitpix, axes, more) + fits_block(fits_numbers(bitpix, values), '\0');
}

struct FitsColumn {
  std::string name;
  char form;  ///< 'D', 'E', 'J' or 'I': one number of that kind a row
  std::vector<double> values;
};

/// A file with nothing but a binary table, whose columns are equally long.
inline std::string fits_table(const std::vector<FitsColumn>& columns) {
  const auto bits = [](char form) { return form == 'D' ? -64 : form == 'E' ? -32 : form == 'J' ? 32 : 16; };
  std::size_t row_bytes = 0, rows = columns.empty() ? 0 : columns[0].values.size();
  std::string fields, data;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    row_bytes += static_cast<std::size_t>(std::abs(bits(columns[c].form)) / 8);
    fields += fits_card("TTYPE" + std::to_string(c + 1), "'" + columns[c].name + "'") +
              fits_card("TFORM" + std::to_string(c + 1), std::string("'1") + columns[c].form + "'");
  }
  for (std::size_t row = 0; row < rows; ++row)
    for (const FitsColumn& column : columns) data += fits_numbers(bits(column.form), {column.values[row]});
  const std::string cards = fits_card("XTENSION", "'BINTABLE'") + fits_card("BITPIX", "8") +
                            fits_card("NAXIS", "2") + fits_card("NAXIS1", std::to_string(row_bytes)) +
                            fits_card("NAXIS2", std::to_string(rows)) + fits_card("PCOUNT", "0") +
                            fits_card("GCOUNT", "1") + fits_card("TFIELDS", std::to_string(columns.size())) +
                            fields + "END";
  return fits_header(8, {}) + fits_block(cards, ' ') + fits_block(data, '\0');
}

}  // namespace vegard::tests
