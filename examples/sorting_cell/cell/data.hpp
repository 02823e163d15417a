// What goes through the channels: nothing of its own, since the chart says which domains they carry.
#pragma once
