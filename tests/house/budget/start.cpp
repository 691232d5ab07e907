// A program that loads the libraries of a picture's formats and ends: the measure of what starts take in the budgets of
// tests/house/budget.json. It stays as it is, as reference.cpp does.
#include <OpenImageIO/imageio.h>

int main() {
  return OIIO::openimageio_version() > 0 ? 0 : 1;
}
