//! Commands of STK500 version 1 as bytes, as far as Optiboot knows them and they are of use here.

/// The last byte of every command.
pub const END: u8 = b' ';
/// First byte of every answer.
pub const IN_SYNC: u8 = 0x14;
/// Last byte of every answer.
pub const OK: u8 = 0x10;

/// Is anybody there?
pub const GET_SYNC: u8 = b'0';
/// The three bytes that name the chip.
pub const READ_SIGNATURE: u8 = b'u';
/// The address in words that the next page has.
pub const LOAD_ADDRESS: u8 = b'U';
/// A page follows.
pub const WRITE_PAGE: u8 = b'd';
/// A page is asked for.
pub const READ_PAGE: u8 = b't';
/// Start the application.
pub const LEAVE: u8 = b'Q';
/// The memory that a page is in: flash.
pub const FLASH: u8 = b'F';

/// A command that has nothing more to say.
pub fn plain(command: u8) -> Vec<u8> {
    vec![command, END]
}

/// The next page is at this byte.
pub fn load_address(at: u16) -> Vec<u8> {
    let [low, high] = (at / 2).to_le_bytes();
    vec![LOAD_ADDRESS, low, high, END]
}

/// Erases a page and writes it.
pub fn write_page(page: &[u8]) -> Vec<u8> {
    let [high, low] = (page.len() as u16).to_be_bytes();
    [&[WRITE_PAGE, high, low, FLASH], page, &[END]].concat()
}

/// Reads so many bytes, at most 255.
pub fn read_page(len: usize) -> Vec<u8> {
    let [high, low] = (len as u16).to_be_bytes();
    vec![READ_PAGE, high, low, FLASH, END]
}
