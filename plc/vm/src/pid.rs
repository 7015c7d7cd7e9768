//! PID: the loop calculation of the S7-200. When it runs is the program's business.
//!
//! The board's twin (firmware/modules/pid.s) does the same operations in the same order.

use crate::real::{add, divide, multiply, subtract};

/// The reals of a loop table, in their order: process variable PVn, setpoint SPn, output Mn, gain
/// Kc, sample time Ts in seconds, integral time Ti and derivative time Td in minutes, bias MX (the
/// integral sum), and PVn-1.
pub type LoopTable = [f32; 9];

/// 2^113: an integral time from here on has no effect.
const NO_INTEGRAL: f32 = f32::from_bits(0x7800_0000);

/// Executes PID once; `is_start` when power flow has come since the last scan: the setpoint then
/// starts at the process variable and the bias at the output, so that the output does not jump.
///
/// A gain of zero means no proportional action, and 1 as the gain of the other two. An integral
/// time that is zero, very large or infinite means no integral action: the bias is part of the
/// output and stays what it is. A derivative time of zero means no derivative action. The output is
/// kept within 0.0 to 1.0, and so is the bias; at a limit the bias becomes what the output lacks
/// (anti-windup). `None` when an operation has no result: the table then is as it was.
pub fn execute(table: &LoopTable, is_start: bool) -> Option<LoopTable> {
    let [
        process,
        mut setpoint,
        output,
        gain,
        sample_time,
        integral_time,
        derivative_time,
        mut bias,
        mut last,
    ] = *table;
    if is_start {
        (setpoint, last, bias) = (process, process, output);
    }
    let error = subtract(setpoint, process)?;
    let other_gain = if gain == 0.0 { 1.0 } else { gain };

    let mut sum = bias;
    let integrates = integral_time != 0.0 && integral_time.abs() < NO_INTEGRAL;
    if integrates {
        let share = divide(multiply(other_gain, sample_time)?, multiply(integral_time, 60.0)?)?;
        sum = add(multiply(share, error)?, bias)?;
    }
    let mut rest = multiply(gain, error)?;
    if derivative_time != 0.0 {
        let share = divide(multiply(other_gain, multiply(derivative_time, 60.0)?)?, sample_time)?;
        rest = add(multiply(share, subtract(last, process)?)?, rest)?;
    }
    let unlimited = add(sum, rest)?;
    let output = limit(unlimited);
    if output.to_bits() != unlimited.to_bits() {
        sum = subtract(output, rest)?;
    }
    if integrates {
        bias = limit(sum);
    }
    Some([
        process,
        setpoint,
        output,
        gain,
        sample_time,
        integral_time,
        derivative_time,
        bias,
        process,
    ])
}

/// The nearest value from 0.0 to 1.0.
fn limit(x: f32) -> f32 {
    if x.is_sign_negative() { 0.0 } else { x.min(1.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Setpoint 0.75, process variable 0.5, gain 2, 1 s, 10 min, 0 min, bias 0.25.
    const TABLE: LoopTable = [0.5, 0.75, 0.0, 2.0, 1.0, 10.0, 0.0, 0.25, 0.4];

    fn output_and_bias(table: LoopTable) -> Option<(f32, f32)> {
        execute(&table, false).map(|table| (table[2], table[7]))
    }

    fn with(changes: &[(usize, f32)]) -> LoopTable {
        let mut table = TABLE;
        changes.iter().for_each(|&(index, value)| table[index] = value);
        table
    }

    #[test]
    fn proportional_and_integral() {
        let sum = 0.25 + 2.0 / 600.0 * 0.25;
        assert_eq!(output_and_bias(TABLE), Some((sum + 0.5, sum)));
        assert_eq!(execute(&TABLE, false).map(|table| table[8]), Some(0.5), "PVn-1");
    }

    #[test]
    fn each_action_can_be_left_out() {
        for none in [f32::INFINITY, f32::MAX, 0.0] {
            assert_eq!(output_and_bias(with(&[(5, none)])), Some((0.75, 0.25)), "no I");
        }
        let sum = 0.25 + 1.0 / 600.0 * 0.25;
        assert_eq!(
            output_and_bias(with(&[(3, 0.0)])),
            Some((sum, sum)),
            "no P: the gain of I is 1"
        );
        let derivative = output_and_bias(with(&[(5, f32::INFINITY), (6, 0.01), (8, 0.625)]));
        assert_eq!(derivative, Some((2.0 * (0.01 * 60.0) * 0.125 + 0.5 + 0.25, 0.25)));
    }

    #[test]
    fn output_and_bias_stay_in_range() {
        assert_eq!(output_and_bias(with(&[(3, 4.0)])), Some((1.0, 0.0)), "1.0 - 4.0 * 0.25");
        assert_eq!(
            output_and_bias(with(&[(0, 0.875), (7, 0.125)])),
            Some((0.0, 0.25)),
            "-2.0 * (0.75 - 0.875)"
        );
        assert_eq!(
            output_and_bias(with(&[(3, 16.0)])),
            Some((1.0, 0.0)),
            "a bias of -3.0 is limited too"
        );
    }

    #[test]
    fn a_start_does_not_jump() {
        let started = execute(&with(&[(2, 0.625)]), true);
        assert_eq!(started, Some([0.5, 0.5, 0.625, 2.0, 1.0, 10.0, 0.0, 0.625, 0.5]));
    }

    #[test]
    fn what_has_no_result_changes_nothing() {
        assert_eq!(execute(&with(&[(4, 0.0), (6, 1.0)]), false), None, "D without a sample time");
        assert_eq!(execute(&with(&[(0, f32::NAN)]), false), None);
        assert_eq!(execute(&with(&[(3, f32::MAX), (0, -9.0)]), false), None);
    }
}
