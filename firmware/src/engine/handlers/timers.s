; Timers and counters. As all handlers (contacts.s).

% Ton TimerSlot IntConst
    rcall timer_constant
    rcall on_delay
    rjmp next_x

% Ton TimerSlot Word
    rcall timer_word
    rcall on_delay
    rjmp next_x

% Tof TimerSlot IntConst
    rcall timer_constant
    rcall off_delay
    rjmp next_x

% Tof TimerSlot Word
    rcall timer_word
    rcall off_delay
    rjmp next_x

% Tonr TimerSlot IntConst
    rcall timer_constant
    rcall retentive_on_delay
    rjmp next_x

% Tonr TimerSlot Word
    rcall timer_word
    rcall retentive_on_delay
    rjmp next_x

% Ctu CounterSlot IntConst
    rcall counter_constant
    rcall count_up
    rjmp next_x

% Ctu CounterSlot Word
    rcall counter_word
    rcall count_up
    rjmp next_x

% Ctd CounterSlot IntConst
    rcall counter_constant
    rcall count_down
    rjmp next_x

% Ctd CounterSlot Word
    rcall counter_word
    rcall count_down
    rjmp next_x

% Ctud CounterSlot IntConst
    rcall counter_constant
    rcall count_up_down
    rjmp next_x

% Ctud CounterSlot Word
    rcall counter_word
    rcall count_up_down
    rjmp next_x
