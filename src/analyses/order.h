#pragma once

#include "analyses/discretization_error.h" // resolve_order
