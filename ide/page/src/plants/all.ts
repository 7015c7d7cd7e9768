// The plants that there are drawings of.
import type { Picture } from "./picture";
import { station1 } from "./station1";
import { tank } from "./tank";

/** In the order in which they are offered. */
export const PICTURES: readonly Picture[] = [station1, tank];
