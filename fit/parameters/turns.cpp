#include "fit/parameters/turns.h"

#include <cmath>

namespace vegard::fit {

double full_turn(const FreeNumber& number) {
  // A formula may well tell a turn from none: half of it is half a turn.
  if (!number.is_angle() || number.in_expressions) return 0.0;
  return number.unit() == "rad" ? 2.0 * std::acos(-1.0) : 360.0;
}

double without_turns(const FreeNumber& number, double value) {
  const double turn = full_turn(number);
  if (turn == 0.0 || number.min > number.id.row->min || number.max < number.id.row->max) return value;
  return value - turn * std::floor(value / turn);
}

double apart(const FreeNumber& number, double a, double b) {
  const double turn = full_turn(number);
  return turn > 0.0 ? std::abs(std::remainder(a - b, turn)) : std::abs(a - b);
}

}  // namespace vegard::fit
