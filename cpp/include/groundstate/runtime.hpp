// The whole runtime; each of these can be included alone.
#pragma once

#include "asynchronous_task.hpp"
#include "clock.hpp"
#include "locked_buffer.hpp"
#include "message_queue.hpp"
#include "periodic_task.hpp"
#include "realtime.hpp"
#include "virtual_clock.hpp"
#include "wait_free_buffer.hpp"
