#include "eigen/decompositions.h"

WHIRL_DECOMPOSITIONS(template);
