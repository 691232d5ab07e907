// Landscapes at night whose skyline is known: what a camera on a tripod has in its picture.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "fit/photo/photo.h"
#include "tests/support/made_sky.h"

namespace vegard::tests {

/// Light in shares of white. The ground's is that at the skyline; snow (or a lake) lies in front of it from
/// `shore` on.
struct Landscape {
  const char* name;
  double sky = 0.03;    ///< at the horizon; half of it overhead
  double arc = 0.25;    ///< a band's peak, wide and soft
  double arc_at = 0.4;  ///< share of the height
  double ground = 0.004;
  double hills = 0.04;        ///< of the height, up and down
  double base = 0.75;         ///< the skyline's share of the height
  double tree_height = 0.0;   ///< of the height; conifers as wide at the foot as a fifth of that
  double tree_density = 0.0;  ///< trees a width, per tree's foot
  double snow = -1.0;         ///< light of a foreground; none below 0
  double shore = 0.08;        ///< of the height, under the skyline; 0: the snow begins at it
  double slope = 0.0;         ///< of the skyline, rows a column
  double walls = 0.0;         ///< wood on both sides: share of the width, up to a quarter of the height
  int houses = 0;             ///< with upright walls, a tenth to a quarter of the height
  int trunks = 0;             ///< bare trees half of the height tall, three columns wide
  double noise = 0.003;
};

struct MadeLandscape {
  fit::Photo photo;
  std::vector<double> skyline_px;  ///< per column the row at which the ground begins
};

inline MadeLandscape made_landscape(const Landscape& kind, int width, int height, std::uint64_t seed) {
  MadeLandscape made;
  const auto random = [&](std::uint32_t i, std::uint32_t j) {
    return sim::uniform(sim::random_words(seed, sim::Stream::stars, i, j, 11)[0]);
  };
  const double phase = 6.28 * random(0, 0);
  std::vector<double> hills(width);
  for (int x = 0; x < width; ++x) {
    const double u = static_cast<double>(x) / width;
    hills[x] = kind.base * height + kind.slope * (x - 0.5 * width) +
               kind.hills * height * (std::sin(5.0 * u + phase) + 0.3 * std::sin(23.0 * u + 2.0 * phase));
  }
  made.skyline_px = hills;
  const double foot = 0.2 * kind.tree_height * height;
  const int trees = foot > 0.0 ? static_cast<int>(kind.tree_density * width / foot) : 0;
  for (int t = 0; t < trees; ++t) {
    const double at = width * random(1, t), high = kind.tree_height * height * (0.5 + 0.5 * random(2, t));
    const double half = 0.1 * high;
    const int first = std::max(0, static_cast<int>(at - half)),
              last = std::min(width - 1, static_cast<int>(at + half));
    for (int x = first; x <= last; ++x) {
      // Branches: the outline of a conifer goes in and out.
      const double in = std::clamp(std::abs(x + 0.5 - at) / half, 0.0, 1.0);
      made.skyline_px[x] = std::min(made.skyline_px[x], hills[x] - high * (1.0 - in));
    }
  }
  for (int h = 0; h < kind.houses + kind.trunks; ++h) {
    const bool house = h < kind.houses;
    const double at = width * (house ? (h + 0.2 + 0.6 * random(7, h)) / kind.houses : random(7, h));
    const double wide = house ? 0.5 * width / kind.houses : 3.0,
                 high = house ? 0.1 + 0.15 * random(8, h) : 0.25 + 0.25 * random(8, h);
    for (int x = std::max(0, static_cast<int>(at - 0.5 * wide)); x < std::min<double>(width, at + 0.5 * wide);
         ++x)
      made.skyline_px[x] = std::min(made.skyline_px[x], (kind.base - high) * height);
  }
  for (int x = 0; x < width && kind.walls > 0.0; ++x) {
    const double edge = std::min(x, width - 1 - x) / (kind.walls * width);
    if (edge < 1.0) made.skyline_px[x] = std::min(made.skyline_px[x], 0.25 * height + 6.0 * random(3, x));
  }
  made.photo = even_sky(width, height, 0.0f);
  for (int x = 0; x < width; ++x)
    for (int y = 0; y < height; ++y) {
      const double d =
          (y - (kind.arc_at + 0.05 * std::sin(4.0 * x / width + phase)) * height) / (0.07 * height);
      // An arc is sharper below than above.
      const double arc = kind.arc * std::exp(-d * d * (d > 0.0 ? 2.0 : 0.5));
      double light = kind.sky * (0.5 + 0.5 * y / height) + arc;
      const double below = y + 0.5 - made.skyline_px[x];
      // A pixel on the line has of both.
      const double share = std::clamp(below + 0.5, 0.0, 1.0);
      const bool in_front = kind.snow >= 0.0 && y + 0.5 > hills[x] + kind.shore * height;
      light = (1.0 - share) * light + share * (in_front ? kind.snow : kind.ground);
      for (int c = 0; c < 3; ++c)
        made.photo.linear.at(x, y, c) = static_cast<float>(light * (c == 1 ? 1.0 : 0.7));
    }
  for (int s = 0; s < 120; ++s) {
    const double x = width * random(4, s), y = height * random(5, s);
    const int column = std::clamp(static_cast<int>(x), 0, width - 1);
    if (y > made.skyline_px[column] - 3.0) continue;
    for (int j = -3; j <= 3; ++j)
      for (int i = -3; i <= 3; ++i) {
        const int u = column + i, v = static_cast<int>(y) + j;
        if (u < 0 || v < 0 || u >= width || v >= height) continue;
        for (int c = 0; c < 3; ++c)
          made.photo.linear.at(u, v, c) +=
              static_cast<float>(0.4 * random(6, s) * std::exp(-(i * i + j * j) / 1.5));
      }
  }
  add_noise(made.photo, kind.noise, seed);
  for (float& value : made.photo.linear.data) value = std::max(value, 0.0f);
  return made;
}

inline std::vector<Landscape> landscapes() {
  std::vector<Landscape> all;
  const auto add = [&](const char* name, auto change) {
    Landscape one{name};
    change(one);
    all.push_back(one);
  };
  add("flat", [](Landscape& l) { l.hills = 0.002; });
  add("hills", [](Landscape&) {});
  add("ridge of 30 degrees", [](Landscape& l) {
    l.slope = 0.35;
    l.base = 0.7;
  });
  add("black trees before a bright sky", [](Landscape& l) {
    l.sky = 0.25;
    l.ground = 0.0005;
    l.tree_height = 0.25;
    l.tree_density = 1.0;
  });
  add("black trees, few", [](Landscape& l) {
    l.sky = 0.15;
    l.ground = 0.0005;
    l.tree_height = 0.25;
    l.tree_density = 0.25;
  });
  add("black trees, dense and tall", [](Landscape& l) {
    l.sky = 0.1;
    l.ground = 0.0005;
    l.tree_height = 0.45;
    l.tree_density = 2.5;
    l.base = 0.85;
  });
  add("black trees before an arc", [](Landscape& l) {
    l.sky = 0.02;
    l.arc = 0.4;
    l.arc_at = 0.6;
    l.ground = 0.0005;
    l.tree_height = 0.2;
    l.tree_density = 1.0;
  });
  add("small trees", [](Landscape& l) {
    l.sky = 0.05;
    l.tree_height = 0.06;
    l.tree_density = 1.5;
  });
  add("wood on both sides", [](Landscape& l) {
    l.sky = 0.1;
    l.walls = 0.2;
    l.ground = 0.001;
  });
  add("houses", [](Landscape& l) {
    l.houses = 4;
    l.hills = 0.002;
    l.base = 0.85;
  });
  add("trunks", [](Landscape& l) {
    l.trunks = 12;
    l.ground = 0.001;
  });
  add("snow brighter than the sky", [](Landscape& l) {
    l.ground = 0.12;
    l.snow = 0.15;
    l.shore = 0.1;
  });
  add("snow before dark hills", [](Landscape& l) { l.snow = 0.15; });
  add("snow a little brighter", [](Landscape& l) {
    l.ground = 0.05;
    l.snow = 0.05;
  });
  add("a dim sky, noisy", [](Landscape& l) {
    l.sky = 0.015;
    l.ground = 0.004;
    l.noise = 0.006;
  });
  add("low in the picture", [](Landscape& l) {
    l.base = 0.93;
    l.hills = 0.01;
  });
  return all;
}

/// Share of the columns that are within the tolerance of the truth.
inline double share_right(const std::vector<double>& found, const std::vector<double>& truth,
                          double tolerance_px) {
  int right = 0;
  for (std::size_t x = 0; x < truth.size(); ++x) right += std::abs(found[x] - truth[x]) <= tolerance_px;
  return static_cast<double>(right) / static_cast<double>(truth.size());
}

}  // namespace vegard::tests
