/*
 * What src/ffi.rs needs from libsimavr, as plain functions: no struct of simavr is known in Rust.
 * Logic belongs there; here is only what must touch simavr's structs or be called back by it.
 */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <simavr/sim_avr.h>
#include <simavr/sim_interrupts.h>
#include <simavr/avr_adc.h>
#include <simavr/avr_eeprom.h>
#include <simavr/avr_extint.h>
#include <simavr/avr_ioport.h>
#include <simavr/avr_uart.h>
#include <simavr/avr_watchdog.h>

enum {
	MARK_REGISTER = 0x3e, /* GPIOR0 */
	EEPROM_CONTROL = 0x3f, /* EECR; EEDR and the two bytes of EEAR follow */
	EEPROM_READ = 1 << 0,
	EEPROM_WRITE = 1 << 1,
	EEPROM_ENABLE = 1 << 2,
	EEPROM_WRITE_US = 3400,
	EEPROM_LEN = 1024,
	RESET_FLAGS = 0x54,   /* MCUSR */
	UART_CONTROL = 0xc1,  /* UCSR0B */
	RESET_BY_WATCHDOG = 1 << 3,
	/* simavr does not wrap addresses as the chip does: with room for all 16 bits none leads out. */
	REACHABLE_DATA = 0x10000,
	/* And a page more, which SPM fills from any address. */
	REACHABLE_FLASH = 0x10000 + 0x100,
	/* Cycles between two looks at simavr's timers if none is due before. */
	RUN_CYCLES = 1000,
	PORTS = 3,
	/* Timer 1. */
	TIMER_CONTROL_A = 0x80, /* TCCR1A */
	TIMER_CONTROL_B = 0x81, /* TCCR1B */
	TIMER_FORCE = 0x82,     /* TCCR1C */
	TIMER_COUNT = 0x84,     /* TCNT1 */
	TIMER_TOP = 0x86,       /* ICR1 */
	TIMER_COMPARE = 0x88,   /* OCR1A; OCR1B follows */
	TIMER_REGISTERS = 12,
	TIMER_OVERFLOW = 13,    /* The interrupt's vector. */
	WAVES = 2,
	COMPARE_CLEARS = 2,
	COMPARE_SETS = 3,
};

/* What shim_run and shim_step return. */
enum { RAN_ON, RAN_TO_MARK, CRASHED };

struct bytes {
	uint8_t *at;
	size_t len, room, taken;
};

struct handler {
	avr_io_write_t write;
	void *param;
};

/* What timer 1 makes of its output OC1A or OC1B: its level, and the compare value in force. */
struct wave {
	int level;
	uint16_t compare;
};

struct shim {
	avr_t *avr;
	struct wave waves[WAVES];
	/* Whether timer 1 counts in fast PWM up to ICR1. */
	int waves_run;
	/* When its count was 0 last, or would have been. */
	avr_cycle_count_t bottom;
	/* simavr's own for writes to timer 1, from TCCR1A on. */
	struct handler timer_handlers[TIMER_REGISTERS];
	/* While they are watched their edges, each as the cycle, which of both, and
	 * the level in the lowest bit. */
	struct bytes edges;
	int edges_are_watched;
	int marked;
	uint8_t mark;
	/* Pins that are driven from outside, and their levels: a byte for each of the ports B, C, D. */
	uint8_t driven[PORTS], levels[PORTS];
	struct bytes to_uart, from_uart;
	/* For each byte that has come what UCSR0B was then. */
	struct bytes from_uart_controls;
	int uart_is_full;
	/* Address of the byte that is being written, or EEPROM_LEN; how often each
	 * was; whether it was disturbed. */
	uint32_t eeprom_writing, eeprom_writes[EEPROM_LEN];
	int eeprom_is_misused;
};

static int append(struct bytes *bytes, const uint8_t *more, size_t len)
{
	if (bytes->taken == bytes->len)
		bytes->taken = bytes->len = 0;
	if (bytes->len + len > bytes->room) {
		size_t room = 2 * (bytes->len + len);
		uint8_t *at = realloc(bytes->at, room);
		if (!at)
			return 0;
		bytes->at = at;
		bytes->room = room;
	}
	memcpy(bytes->at + bytes->len, more, len);
	bytes->len += len;
	return 1;
}

static void on_mark(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
	struct shim *shim = param;
	avr->data[address] = value;
	shim->mark = value;
	shim->marked = 1;
	/* Ends the batch with this instruction. */
	avr->run_cycle_count = 1;
}

static uint32_t eeprom_address(avr_t *avr)
{
	return avr->data[EEPROM_CONTROL + 2] | (avr->data[EEPROM_CONTROL + 3] & 3) << 8;
}

static avr_cycle_count_t on_eeprom_written(avr_t *avr, avr_cycle_count_t when, void *param)
{
	struct shim *shim = param;
	(void)when;
	if (shim->eeprom_writing != eeprom_address(avr))
		shim->eeprom_is_misused = 1;
	avr->data[EEPROM_CONTROL] &= ~EEPROM_WRITE;
	shim->eeprom_writing = EEPROM_LEN;
	return 0;
}

/* simavr writes in no time. A chip is busy for a while, and must then be left
 * alone. Called after simavr's own. */
static void on_eeprom_control(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
	struct shim *shim = param;
	uint8_t *control = avr->data + address;
	if (shim->eeprom_writing < EEPROM_LEN) {
		if (value & (EEPROM_READ | EEPROM_ENABLE))
			shim->eeprom_is_misused = 1;
		*control |= EEPROM_WRITE;
	} else if (value & EEPROM_WRITE && value & EEPROM_ENABLE && !(*control & EEPROM_ENABLE)) {
		shim->eeprom_writing = eeprom_address(avr);
		shim->eeprom_writes[shim->eeprom_writing]++;
		*control |= EEPROM_WRITE;
		avr_cycle_timer_register_usec(avr, EEPROM_WRITE_US, on_eeprom_written, shim);
	}
}

static void no_sleep(avr_t *avr, avr_cycle_count_t cycles)
{
	(void)avr;
	(void)cycles;
}

static avr_irq_t *uart_irq(struct shim *shim, int irq)
{
	return avr_io_getirq(shim->avr, AVR_IOCTL_UART_GETIRQ('0'), irq);
}

/* The UART's fifo takes bytes until it says that it is full, in the middle of taking one. */
static void feed_uart(struct shim *shim)
{
	struct bytes *bytes = &shim->to_uart;
	while (!shim->uart_is_full && bytes->taken < bytes->len)
		avr_raise_irq(uart_irq(shim, UART_IRQ_INPUT), bytes->at[bytes->taken++]);
}

static void on_uart_full(avr_irq_t *irq, uint32_t value, void *param)
{
	(void)irq;
	if (value)
		((struct shim *)param)->uart_is_full = 1;
}

static void on_uart_ready(avr_irq_t *irq, uint32_t value, void *param)
{
	(void)irq;
	(void)value;
	((struct shim *)param)->uart_is_full = 0;
	feed_uart(param);
}

static void on_uart_output(avr_irq_t *irq, uint32_t value, void *param)
{
	struct shim *shim = param;
	uint8_t byte = value;
	(void)irq;
	if (append(&shim->from_uart, &byte, 1))
		append(&shim->from_uart_controls, shim->avr->data + UART_CONTROL, 1);
}

static void connect_uart(struct shim *shim)
{
	/* Neither lines on the console nor real pauses. */
	uint32_t flags = 0;
	avr_ioctl(shim->avr, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
	avr_irq_register_notify(uart_irq(shim, UART_IRQ_OUTPUT), on_uart_output, shim);
	avr_irq_register_notify(uart_irq(shim, UART_IRQ_OUT_XON), on_uart_ready, shim);
	avr_irq_register_notify(uart_irq(shim, UART_IRQ_OUT_XOFF), on_uart_full, shim);
}

/*
 * The outputs of timer 1 in fast PWM up to ICR1 (mode 14), by the data sheet. simavr has them,
 * but takes no new compare
 * value until the mode changes, knows no forced compare, and gives other levels when the compare
 * value is the top.
 */
static uint32_t timer_word(avr_t *avr, int low)
{
	return avr->data[low] | avr->data[low + 1] << 8;
}

static int timer_divider(avr_t *avr)
{
	static const int dividers[8] = { 0, 1, 8, 64, 256, 1024, 0, 0 };
	return dividers[avr->data[TIMER_CONTROL_B] & 7];
}

static int waves_can_run(avr_t *avr)
{
	return (avr->data[TIMER_CONTROL_A] & 3) == 2 && (avr->data[TIMER_CONTROL_B] & 0x18) == 0x18 &&
			timer_divider(avr);
}

static int wave_mode(avr_t *avr, int wave)
{
	return avr->data[TIMER_CONTROL_A] >> (6 - 2 * wave) & 3;
}

static void set_wave(struct shim *shim, int wave, int level, avr_cycle_count_t when)
{
	uint64_t edge = when << 2 | wave << 1 | level;
	if (shim->edges_are_watched && shim->waves[wave].level != level)
		append(&shim->edges, (uint8_t *)&edge, sizeof edge);
	shim->waves[wave].level = level;
}

static void match(struct shim *shim, int wave, avr_cycle_count_t when)
{
	int mode = wave_mode(shim->avr, wave);
	if (mode == COMPARE_CLEARS || mode == COMPARE_SETS)
		set_wave(shim, wave, mode == COMPARE_SETS, when);
}

static avr_cycle_count_t on_match_a(avr_t *avr, avr_cycle_count_t when, void *param)
{
	(void)avr;
	match(param, 0, when);
	return 0;
}

static avr_cycle_count_t on_match_b(avr_t *avr, avr_cycle_count_t when, void *param)
{
	(void)avr;
	match(param, 1, when);
	return 0;
}

/*
 * The timer has come to this count: when it comes to the compare values, if it does before the
 * top, where the bottom wins.
 * That can have been since simavr looked at its timers last.
 */
static void await_matches(struct shim *shim, uint32_t count)
{
	static const avr_cycle_timer_t on_match[WAVES] = { on_match_a, on_match_b };
	avr_t *avr = shim->avr;
	for (int wave = 0; wave < WAVES; wave++) {
		uint32_t compare = shim->waves[wave].compare;
		avr_cycle_count_t when = shim->bottom + (compare + 1) * timer_divider(avr);
		avr_cycle_timer_cancel(avr, on_match[wave], shim);
		if (!shim->waves_run || compare < count || compare >= timer_word(avr, TIMER_TOP))
			continue;
		if (when > avr->cycle)
			avr_cycle_timer_register(avr, when - avr->cycle, on_match[wave], shim);
		else
			match(shim, wave, when);
	}
}

static void on_bottom(struct shim *shim)
{
	avr_t *avr = shim->avr;
	avr_cycle_count_t due = shim->bottom + (timer_word(avr, TIMER_TOP) + 1) * timer_divider(avr);
	/* simavr looks at its timers between two instructions, and is up to a count
	 * early where the count was set. */
	avr_cycle_count_t early_max = timer_divider(avr) + 16;
	shim->bottom = avr->cycle + early_max - due < 2 * early_max ? due : avr->cycle;
	for (int wave = 0; wave < WAVES; wave++) {
		int mode = wave_mode(avr, wave);
		shim->waves[wave].compare = timer_word(avr, TIMER_COMPARE + 2 * wave);
		if (mode == COMPARE_CLEARS || mode == COMPARE_SETS)
			set_wave(shim, wave, mode == COMPARE_CLEARS, shim->bottom);
	}
	await_matches(shim, 0);
}

static void on_timer_overflow(avr_irq_t *irq, uint32_t value, void *param)
{
	(void)irq;
	if (value && ((struct shim *)param)->waves_run)
		on_bottom(param);
}

static void on_timer_count(struct shim *shim)
{
	avr_t *avr = shim->avr;
	uint32_t count = timer_word(avr, TIMER_COUNT);
	/* From above the top it comes to the bottom by way of 0xffff; simavr goes there at once. */
	shim->bottom = avr->cycle - count * timer_divider(avr);
	if (shim->waves_run && count > timer_word(avr, TIMER_TOP))
		on_bottom(shim);
	else
		await_matches(shim, count);
}

static void on_timer_force(struct shim *shim, uint8_t value)
{
	avr_t *avr = shim->avr;
	avr->data[TIMER_FORCE] = 0;
	for (int wave = 0; wave < WAVES; wave++)
		if (!(avr->data[TIMER_CONTROL_A] & 3) && value >> (7 - wave) & 1)
			match(shim, wave, avr->cycle);
}

/* In the place of simavr's own, which it calls: simavr shares no more than four registers. */
static void on_timer_write(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
	struct shim *shim = param;
	struct handler *own = &shim->timer_handlers[address - TIMER_CONTROL_A];
	if (own->write)
		own->write(avr, address, value, own->param);
	avr->data[address] = value;
	if (address == TIMER_FORCE)
		on_timer_force(shim, value);
	if (address == TIMER_COUNT)
		on_timer_count(shim);
	if (address >= TIMER_COMPARE && !shim->waves_run)
		shim->waves[(address - TIMER_COMPARE) / 2].compare = timer_word(avr, address);
	if (shim->waves_run != waves_can_run(avr)) {
		shim->waves_run = waves_can_run(avr);
		shim->bottom = avr->cycle;
		await_matches(shim, 0);
	}
}

static void connect_timer(struct shim *shim)
{
	static const int registers[] = { TIMER_CONTROL_A, TIMER_CONTROL_B, TIMER_FORCE,
					 TIMER_COUNT, TIMER_COMPARE, TIMER_COMPARE + 2 };
	avr_t *avr = shim->avr;
	for (size_t i = 0; i < sizeof registers / sizeof *registers; i++) {
		struct handler *own = &shim->timer_handlers[registers[i] - TIMER_CONTROL_A];
		own->write = avr->io[AVR_DATA_TO_IO(registers[i])].w.c;
		own->param = avr->io[AVR_DATA_TO_IO(registers[i])].w.param;
		avr->io[AVR_DATA_TO_IO(registers[i])].w.c = on_timer_write;
		avr->io[AVR_DATA_TO_IO(registers[i])].w.param = shim;
	}
	avr_irq_t *overflow = avr_get_interrupt_irq(avr, TIMER_OVERFLOW);
	avr_irq_register_notify(overflow + AVR_INT_IRQ_PENDING, on_timer_overflow, shim);
}

/* A larger copy of one of simavr's two memories; it frees them with free. */
static int enlarge(uint8_t **memory, size_t old_len, size_t new_len)
{
	if (new_len <= old_len)
		return 1;
	uint8_t *larger = realloc(*memory, new_len);
	if (!larger)
		return 0;
	memset(larger + old_len, 0xff, new_len - old_len);
	*memory = larger;
	return 1;
}

void shim_free(struct shim *shim)
{
	avr_t *avr = shim->avr;
	if (avr) {
		avr_terminate(avr);
		/* avr_terminate leaves the signals of registers and interrupts, the
		 * list of them, and the chip itself. */
		for (int i = 0; i < MAX_IOs; i++)
			avr_free_irq(avr->io[i].irq, AVR_IOMEM_IRQ_ALL + 1);
		for (int i = 0; i < avr->interrupts.vector_count; i++)
			avr_free_irq(avr->interrupts.vector[i]->irq, AVR_INT_IRQ_COUNT);
		avr_free_irq(avr->interrupts.irq, AVR_INT_IRQ_COUNT);
		free(avr->irq_pool.irq);
		free(avr);
	}
	free(shim->to_uart.at);
	free(shim->from_uart.at);
	free(shim->from_uart_controls.at);
	free(shim->edges.at);
	free(shim);
}

static void raise_pin(struct shim *shim, int port, int bit, int level)
{
	avr_t *avr = shim->avr;
	/* INT0 and INT1: while their pins are low simavr would look at them in
	 * every cycle, used or not. */
	avr_extint_set_strict_lvl_trig(avr, 0, 0);
	avr_extint_set_strict_lvl_trig(avr, 1, 0);
	avr_raise_irq(avr_io_getirq(avr, AVR_IOCTL_IOPORT_GETIRQ('B' + port), bit), level);
}

void shim_drive(struct shim *shim, int port, int bit, int level)
{
	shim->driven[port] |= 1 << bit;
	shim->levels[port] &= ~(1 << bit);
	shim->levels[port] |= level << bit;
	/* Without this a pull-up would win over what drives the pin. */
	avr_ioport_external_t external = { .name = 'B' + port, .mask = shim->driven[port],
			.value = shim->levels[port] };
	avr_ioctl(shim->avr, AVR_IOCTL_IOPORT_SET_EXTERNAL('B' + port), &external);
	raise_pin(shim, port, bit, level);
}

/* simavr has cleared the registers that hold the pins' levels, but passes only changes on. */
static void drive_again(struct shim *shim)
{
	for (int port = 0; port < PORTS; port++)
		for (int bit = 0; bit < 8; bit++)
			if (shim->driven[port] >> bit & 1) {
				int level = shim->levels[port] >> bit & 1;
				raise_pin(shim, port, bit, !level);
				raise_pin(shim, port, bit, level);
			}
}

/* Called by simavr in every reset, those by the watchdog too. */
static void on_reset(avr_t *avr)
{
	struct shim *shim = avr->custom.data;
	drive_again(shim);
	/* Until the receiver is switched on. */
	shim->uart_is_full = 1;
	shim->eeprom_writing = EEPROM_LEN;
	shim->to_uart.len = shim->to_uart.taken = 0;
	shim->waves_run = 0;
	memset(shim->waves, 0, sizeof shim->waves);
}

void shim_reset(struct shim *shim, uint8_t cause)
{
	avr_t *avr = shim->avr;
	avr_reset(avr);
	/* A reset by the watchdog that was due at this moment is done now, and
	 * leaves traces: once more. */
	if (avr->data[RESET_FLAGS] & RESET_BY_WATCHDOG)
		avr_reset(avr);
	avr->data[RESET_FLAGS] = cause;
	shim->from_uart.len = shim->from_uart_controls.len = 0;
}

/* The Uno's chip, or one with room: an ATmega2560 with external memory as far as
 * addresses reach. */
struct shim *shim_new(int has_room)
{
	struct shim *shim = calloc(1, sizeof *shim);
	if (!shim)
		return NULL;
	avr_t *avr = shim->avr = avr_make_mcu_by_name(has_room ? "atmega2560" : "atmega328p");
	if (!avr) {
		shim_free(shim);
		return NULL;
	}
	if (has_room)
		avr->ramend = REACHABLE_DATA - 1;
	avr_init(avr);
	avr->frequency = 16000000;
	avr->vcc = avr->avcc = avr->aref = 5000;
	avr->log = LOG_NONE;
	avr->sleep = no_sleep;
	avr->reset = on_reset;
	avr->custom.data = shim;
	if (!enlarge(&avr->data, avr->ramend + 1, REACHABLE_DATA) ||
	    !enlarge(&avr->flash, avr->flashend + 4, REACHABLE_FLASH)) {
		shim_free(shim);
		return NULL;
	}
	avr_register_io_write(avr, MARK_REGISTER, on_mark, shim);
	avr_register_io_write(avr, EEPROM_CONTROL, on_eeprom_control, shim);
	shim->eeprom_writing = EEPROM_LEN;
	connect_uart(shim);
	connect_timer(shim);
	return shim;
}

uint8_t *shim_flash(struct shim *shim) { return shim->avr->flash; }
size_t shim_flash_len(struct shim *shim) { return shim->avr->flashend + 1; }
uint8_t *shim_data(struct shim *shim) { return shim->avr->data; }
size_t shim_data_len(struct shim *shim) { return shim->avr->ramend + 1; }
uint32_t shim_pc(struct shim *shim) { return shim->avr->pc; }
void shim_set_pc(struct shim *shim, uint32_t pc) { shim->avr->pc = pc; }
void shim_set_reset_pc(struct shim *shim, uint32_t pc) { shim->avr->reset_pc = pc; }
uint64_t shim_cycles(struct shim *shim) { return shim->avr->cycle; }
uint8_t shim_mark(struct shim *shim) { return shim->mark; }

static int run_batch(struct shim *shim, avr_cycle_count_t cycles_max)
{
	/* A reset by the watchdog puts the limit back to 1. */
	shim->avr->run_cycle_limit = cycles_max;
	int state = avr_run(shim->avr);
	if (state != cpu_Running && state != cpu_Sleeping)
		return CRASHED;
	return shim->marked ? RAN_TO_MARK : RAN_ON;
}

int shim_step(struct shim *shim)
{
	shim->marked = 0;
	shim->avr->run_cycle_count = 1;
	return run_batch(shim, 1);
}

static avr_cycle_count_t on_end(avr_t *avr, avr_cycle_count_t when, void *param)
{
	(void)avr;
	(void)when;
	(void)param;
	return 0;
}

int shim_run(struct shim *shim, uint64_t cycles)
{
	avr_t *avr = shim->avr;
	avr_cycle_count_t end = avr->cycle + cycles;
	int result = RAN_ON;
	shim->marked = 0;
	while (result == RAN_ON && avr->cycle < end) {
		/* simavr runs on to its next timer, which every wdr may put off: this one stays. */
		avr_cycle_timer_register(avr, end - avr->cycle, on_end, shim);
		result = run_batch(shim, RUN_CYCLES);
	}
	avr_cycle_timer_cancel(avr, on_end, shim);
	return result;
}

void shim_set_millivolts(struct shim *shim, int channel, uint32_t millivolts)
{
	avr_raise_irq(avr_io_getirq(shim->avr, AVR_IOCTL_ADC_GETIRQ, ADC_IRQ_ADC0 + channel), millivolts);
}

int shim_uart_send(struct shim *shim, const uint8_t *bytes, size_t len)
{
	int sent = append(&shim->to_uart, bytes, len);
	feed_uart(shim);
	return sent;
}

size_t shim_uart_waiting(struct shim *shim) { return shim->to_uart.len - shim->to_uart.taken; }
size_t shim_uart_received(struct shim *shim) { return shim->from_uart.len; }

/* Each byte with its UCSR0B after it. */
void shim_uart_take(struct shim *shim, uint8_t *to)
{
	for (size_t i = 0; i < shim->from_uart.len; i++) {
		*to++ = shim->from_uart.at[i];
		*to++ = i < shim->from_uart_controls.len ? shim->from_uart_controls.at[i] : 0;
	}
	shim->from_uart.len = shim->from_uart_controls.len = 0;
}

int shim_wave(struct shim *shim, int wave) { return shim->waves[wave].level; }
void shim_watch_edges(struct shim *shim) { shim->edges_are_watched = 1; }
size_t shim_edges(struct shim *shim) { return shim->edges.len / sizeof(uint64_t); }

void shim_take_edges(struct shim *shim, uint64_t *to)
{
	memcpy(to, shim->edges.at, shim->edges.len);
	shim->edges.len = 0;
}

static void eeprom(struct shim *shim, uint32_t request, uint8_t *bytes, uint16_t offset,
		uint32_t len)
{
	avr_eeprom_desc_t range = { .ee = bytes, .offset = offset, .size = len };
	avr_ioctl(shim->avr, request, &range);
}

int shim_eeprom_is_misused(struct shim *shim) { return shim->eeprom_is_misused; }
uint32_t shim_eeprom_writing(struct shim *shim) { return shim->eeprom_writing; }
uint32_t shim_eeprom_writes(struct shim *shim, uint16_t at)
{
	return shim->eeprom_writes[at % EEPROM_LEN];
}
size_t shim_eeprom_len(struct shim *shim) { return shim->avr->e2end + 1; }

void shim_eeprom_read(struct shim *shim, uint16_t offset, uint8_t *to, uint32_t len)
{
	eeprom(shim, AVR_IOCTL_EEPROM_GET, to, offset, len);
}

void shim_eeprom_write(struct shim *shim, uint16_t offset, uint8_t *from, uint32_t len)
{
	eeprom(shim, AVR_IOCTL_EEPROM_SET, from, offset, len);
}

void shim_feed_watchdog(struct shim *shim)
{
	avr_ioctl(shim->avr, AVR_IOCTL_WATCHDOG_RESET, NULL);
}
