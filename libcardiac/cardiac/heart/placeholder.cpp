#include "cardiac/heart/beat_result.hpp"
