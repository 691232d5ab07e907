// The measure of the budgets in tests/house/budget.json. The time that the compiler takes for this file is the unit for
// compile times, the time that the program runs is the unit for tests. So it stays as it is: a change here changes the
// meaning of every committed figure, and they are to be written anew.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace {

/// A generator of the same numbers everywhere, from -1 to 1.
class Numbers {
 public:
  double next() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state_ >> 11) / 4503599627370496.0 - 1.0;
  }

 private:
  std::uint64_t state_ = 42;
};

/// The norm of what solving leaves, which is small.
template <typename Matrix>
double residual_of_solving(Numbers& numbers, Eigen::Index size) {
  using Vector = Eigen::Matrix<typename Matrix::Scalar, Eigen::Dynamic, 1>;
  Matrix matrix(size, size);
  for (Eigen::Index at = 0; at < matrix.size(); ++at) {
    matrix.data()[at] = static_cast<typename Matrix::Scalar>(numbers.next());
  }
  const Matrix normal = matrix.transpose() * matrix + Matrix::Identity(size, size);
  const Vector right = Vector::Ones(size);
  const Vector by_rotations = Eigen::HouseholderQR<Matrix>(normal).solve(right);
  const Vector by_factors = Eigen::LDLT<Matrix>(normal).solve(right);
  return static_cast<double>((by_rotations - by_factors).norm());
}

/// Words by how often they stand in the text.
std::map<std::string, int> counts_of_words(const std::string& text) {
  std::map<std::string, int> counts;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    ++counts[word];
  }
  return counts;
}

/// The sum of sines by a function that the compiler does not see through.
double sum_of_sines(const std::function<double(double)>& sine, int terms) {
  double sum = 0.0;
  for (int term = 0; term < terms; ++term) {
    sum += sine(1e-3 * term);
  }
  return sum;
}

}  // namespace

int main() {
  Numbers numbers;
  double residual = 0.0;
  int words = 0;
  for (int round = 0; round < 60; ++round) {
    residual += residual_of_solving<Eigen::MatrixXd>(numbers, 120);
    std::ostringstream text;
    std::vector<double> values(100000);
    std::generate(values.begin(), values.end(), [&] { return numbers.next(); });
    std::sort(values.begin(), values.end());
    for (int word = 0; word < 2000; ++word) {
      text << (values[static_cast<std::size_t>(word) * 50] < 0.0 ? "dark" : "bright") << " sky ";
    }
    words += counts_of_words(text.str())["sky"];
  }
  const double sines = sum_of_sines([](double x) { return std::sin(x); }, 40000000);
  std::cout << "residual " << residual << ", " << words << " words, sum of sines " << sines << "\n";
  return residual < 0.1 && words == 60 * 2000 && std::abs(sines) < 2001.0 ? 0 : 1;
}
