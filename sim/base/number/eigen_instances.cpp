#define VEGARD_EIGEN_INSTANCE template
#include "sim/base/number/eigen_instances.h"
