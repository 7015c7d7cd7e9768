/*
 * What src/ffi.rs needs from libsimavr, as plain functions: no struct of simavr is known in Rust.
 * Logic belongs there; here is only what must touch simavr's structs or be called back by it.
 */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <simavr/sim_avr.h>
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
	RESET_BY_WATCHDOG = 1 << 3,
	/* simavr does not wrap addresses as the chip does: with room for all 16 bits none leads out. */
	REACHABLE_DATA = 0x10000,
	/* And a page more, which SPM fills from any address. */
	REACHABLE_FLASH = 0x10000 + 0x100,
	/* Cycles between two looks at simavr's timers if none is due before. */
	RUN_CYCLES = 1000,
	PORTS = 3,
};

/* What shim_run and shim_step return. */
enum { RAN_ON, RAN_TO_MARK, CRASHED };

struct bytes {
	uint8_t *at;
	size_t len, room, taken;
};

struct shim {
	avr_t *avr;
	int marked;
	uint8_t mark;
	/* Pins that are driven from outside, and their levels: a byte for each of the ports B, C, D. */
	uint8_t driven[PORTS], levels[PORTS];
	struct bytes to_uart, from_uart;
	int uart_is_full;
	/* Address of the byte that is being written, or EEPROM_LEN; how often each was; whether it was disturbed. */
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

/* simavr writes in no time. A chip is busy for a while, and must then be left alone. Called after simavr's own. */
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
	uint8_t byte = value;
	(void)irq;
	append(&((struct shim *)param)->from_uart, &byte, 1);
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

/* A larger copy of one of simavr's two memories; it frees them with free. */
static int enlarge(uint8_t **memory, size_t old_len, size_t new_len)
{
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
		/* avr_terminate leaves the signals of registers and interrupts, the list of them, and the chip itself. */
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
	free(shim);
}

static void raise_pin(struct shim *shim, int port, int bit, int level)
{
	avr_t *avr = shim->avr;
	/* INT0 and INT1: while their pins are low simavr would look at them in every cycle, used or not. */
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
	avr_ioport_external_t external = { .name = 'B' + port, .mask = shim->driven[port], .value = shim->levels[port] };
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
}

void shim_reset(struct shim *shim, uint8_t cause)
{
	avr_t *avr = shim->avr;
	avr_reset(avr);
	/* A reset by the watchdog that was due at this moment is done now, and leaves traces: once more. */
	if (avr->data[RESET_FLAGS] & RESET_BY_WATCHDOG)
		avr_reset(avr);
	avr->data[RESET_FLAGS] = cause;
	shim->from_uart.len = 0;
}

struct shim *shim_new(void)
{
	struct shim *shim = calloc(1, sizeof *shim);
	if (!shim)
		return NULL;
	avr_t *avr = shim->avr = avr_make_mcu_by_name("atmega328p");
	if (!avr) {
		shim_free(shim);
		return NULL;
	}
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

void shim_uart_take(struct shim *shim, uint8_t *to)
{
	memcpy(to, shim->from_uart.at, shim->from_uart.len);
	shim->from_uart.len = 0;
}

static void eeprom(struct shim *shim, uint32_t request, uint8_t *bytes, uint16_t offset, uint32_t len)
{
	avr_eeprom_desc_t range = { .ee = bytes, .offset = offset, .size = len };
	avr_ioctl(shim->avr, request, &range);
}

int shim_eeprom_is_misused(struct shim *shim) { return shim->eeprom_is_misused; }
uint32_t shim_eeprom_writing(struct shim *shim) { return shim->eeprom_writing; }
uint32_t shim_eeprom_writes(struct shim *shim, uint16_t at) { return shim->eeprom_writes[at % EEPROM_LEN]; }
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
