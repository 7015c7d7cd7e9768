//! UF2, as the drive of a board takes it: firmware and image in one file. Who writes files and
//! drives is `host`.

use plc_isa::Drive;

/// Bytes of flash that a block holds: a page.
const PAGE: usize = 256;
/// Bytes that are erased at once. All pages of a sector are in the file: the RP2040's boot ROM
/// takes no sector of which pages are missing for one of the next file (erratum E14).
const SECTOR: usize = 4096;
/// What flash has where nothing is written.
const BLANK: u8 = 0xFF;

/// First words of a block, and its last.
const MAGIC: [u32; 2] = [0x0A32_4655, 0x9E5D_5157];
const MAGIC_END: u32 = 0x0AB1_6F30;
/// The block says which chip it is for: others leave it alone.
const HAS_FAMILY: u32 = 0x2000;
/// Bytes that a block has room for; those after a page count for nothing.
const ROOM: usize = 476;

/// The file that brings firmware and image onto a drive's board, and into force whatever came over
/// its line before. What is elsewhere in its flash, such as retained values, stays.
pub fn uf2(drive: &Drive, firmware: &[u8], image: &[u8]) -> Vec<u8> {
    let parts = [(drive.flash_start, firmware), (drive.slot_start, image)];
    let blank = drive.records.iter().map(|&start| (start, &[BLANK; SECTOR][..]));
    let pages: Vec<_> = parts.into_iter().chain(blank).flat_map(pages_of).collect();
    let block = |(number, (address, page)): (usize, &(u32, [u8; PAGE]))| {
        let [number, count] = [number, pages.len()].map(|count| count as u32);
        let head = [HAS_FAMILY, *address, PAGE as u32, number, count, drive.family];
        let head = MAGIC.into_iter().chain(head).flat_map(u32::to_le_bytes);
        let room = [0; ROOM - PAGE];
        head.chain(*page).chain(room).chain(MAGIC_END.to_le_bytes()).collect::<Vec<_>>()
    };
    pages.iter().enumerate().flat_map(block).collect()
}

/// The pages of what begins at an address, to the end of its last sector, with their addresses.
fn pages_of((start, bytes): (u32, &[u8])) -> Vec<(u32, [u8; PAGE])> {
    let mut sectors = bytes.to_vec();
    sectors.resize(bytes.len().next_multiple_of(SECTOR), BLANK);
    let (pages, _) = sectors.as_chunks();
    (start..).step_by(PAGE).zip(pages.iter().copied()).collect()
}

#[cfg(test)]
mod tests {
    use plc_isa::PICO_DRIVE;

    use super::*;

    #[test]
    fn whole_sectors_in_numbered_blocks() {
        let file = uf2(&PICO_DRIVE, &[1; SECTOR + 1], &[2; 3]);
        let (blocks, rest) = file.as_chunks::<512>();
        assert!(rest.is_empty() && blocks.len() == 5 * SECTOR / PAGE);
        let word = |block: &[u8; 512], at: usize| {
            u32::from_le_bytes([block[at], block[at + 1], block[at + 2], block[at + 3]])
        };
        for (number, block) in blocks.iter().enumerate() {
            let head = [0, 4, 8, 16, 20, 24, 28, 508].map(|at| word(block, at));
            let count = blocks.len() as u32;
            let family = PICO_DRIVE.family;
            let expected =
                [MAGIC[0], MAGIC[1], HAS_FAMILY, 256, number as u32, count, family, MAGIC_END];
            assert_eq!(head, expected);
        }
        let addresses: Vec<u32> = blocks.iter().map(|block| word(block, 12)).collect();
        assert_eq!(
            addresses[..32],
            std::array::from_fn::<u32, 32, _>(|page| {
                PICO_DRIVE.flash_start + 256 * page as u32
            })
        );
        let [first, second] = PICO_DRIVE.records else { panic!("two records") };
        for (index, start) in [PICO_DRIVE.slot_start, *first, *second].into_iter().enumerate() {
            let expected: [u32; 16] = std::array::from_fn(|page| start + 256 * page as u32);
            assert_eq!(addresses[32 + 16 * index..][..16], expected);
        }
        assert_eq!(blocks[16][32..34], [1, BLANK]);
        assert_eq!(blocks[32][32..36], [2, 2, 2, BLANK]);
        assert!(blocks[47..].iter().all(|block| block[32..288] == [BLANK; 256]));
    }
}
