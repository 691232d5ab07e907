#include "sim/base/leap_seconds.h"

#include <array>

namespace vegard::sim {
namespace {

/// Days since 1970 from which TAI - UTC was so many seconds.
struct Leap {
  int day;
  int tai_less_utc_s;
};
constexpr std::array<Leap, 28> kLeaps{
    {{730, 10},   {912, 11},   {1096, 12},  {1461, 13},  {1826, 14},  {2191, 15},  {2557, 16},
     {2922, 17},  {3287, 18},  {3652, 19},  {4199, 20},  {4564, 21},  {4929, 22},  {5660, 23},
     {6574, 24},  {7305, 25},  {7670, 26},  {8217, 27},  {8582, 28},  {8947, 29},  {9496, 30},
     {10043, 31}, {10592, 32}, {13149, 33}, {14245, 34}, {15522, 35}, {16617, 36}, {17167, 37}}};

}  // namespace

double utc_of_tai(double tai_s) {
  constexpr double kSecondsOfDay = 86400.0;
  double utc_s = tai_s - kLeaps.front().tai_less_utc_s;
  for (const Leap& leap : kLeaps)
    if (tai_s - leap.tai_less_utc_s >= leap.day * kSecondsOfDay) utc_s = tai_s - leap.tai_less_utc_s;
  return utc_s;
}

}  // namespace vegard::sim
