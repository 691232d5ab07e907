#include "sim/emit/footprint/map/plane_fft.h"

#include <algorithm>
#include <cstddef>
#include <unsupported/Eigen/FFT>

#include "sim/base/parallel.h"

namespace vegard::sim {
namespace {

using Complex = std::complex<double>;

/// One thread's room.
struct Work {
  Eigen::FFT<double> transform;
  std::vector<Complex> in, out;

  void run(bool backwards) {
    if (backwards)
      transform.inv(out, in);
    else
      transform.fwd(out, in);
  }
};

}  // namespace

int transform_size(int least) {
  for (int n = std::max(2, least + least % 2);; n += 2) {
    int rest = n;
    for (const int prime : {2, 3, 5})
      while (rest % prime == 0) rest /= prime;
    if (rest == 1) return n;
  }
}

void transform_plane(std::vector<Complex>& values, int columns, int rows, bool backwards, int threads) {
  std::vector<Work> work(thread_count(threads));
  parallel_for(rows, threads, [&](std::size_t row, int slot) {
    Work& w = work[slot];
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(row) * columns;
    w.in.assign(begin, begin + columns);
    w.run(backwards);
    std::copy(w.out.begin(), w.out.end(), begin);
  });
  parallel_for(columns, threads, [&](std::size_t column, int slot) {
    Work& w = work[slot];
    w.in.resize(rows);
    for (int r = 0; r < rows; ++r) w.in[r] = values[static_cast<std::size_t>(r) * columns + column];
    w.run(backwards);
    for (int r = 0; r < rows; ++r) values[static_cast<std::size_t>(r) * columns + column] = w.out[r];
  });
}

}  // namespace vegard::sim
