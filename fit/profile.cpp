#include "fit/profile.h"
