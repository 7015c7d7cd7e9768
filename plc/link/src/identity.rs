//! Modbus function 43/14: who answers.

use plc_isa::{LINE_ROOM, NAME_LEN_MAX};

use crate::request::{Answered, Exception, Request};
use crate::station::{Station, TEXTS};

/// The only kind of function 43 that there is.
const READ_DEVICE_IDENTIFICATION: u8 = 14;
/// Basic and regular objects, as a stream and one by one.
const CONFORMITY: u8 = 0x82;

const PRODUCT_CODE: u8 = 1;
const REVISION: u8 = 2;
const USER_APPLICATION_NAME: u8 = 6;

/// Where the objects of an answer begin.
const OBJECTS: u8 = 7;

// The longest answer fits in the least room: that of a frame on the serial line, with its checksum.
const _: () = {
    let texts = TEXTS[0].len() + TEXTS[1].len() + TEXTS[2].len() + NAME_LEN_MAX as usize;
    assert!(OBJECTS as usize + 4 * 2 + texts <= LINE_ROOM as usize - 2);
};

/// Function 43.
pub(crate) fn answer<S: Station>(request: &mut Request<S>) -> Answered {
    if request.byte(1) != READ_DEVICE_IDENTIFICATION {
        return Err(Exception::Function);
    }
    request.expect_len(4)?;
    let (code, wanted) = (request.byte(2), request.byte(3));
    let (mut object, last) = match code {
        1 => (wanted, REVISION),
        2 | 3 => (wanted, USER_APPLICATION_NAME),
        4 => (wanted, wanted),
        _ => return Err(Exception::Value),
    };
    request.set_byte(3, CONFORMITY);
    request.set_word(4, 0);
    request.out = OBJECTS;
    if code != 4 && object > REVISION && object != USER_APPLICATION_NAME {
        object = 0;
    }
    let mut count = 0;
    loop {
        count += request.put_object(object);
        if object >= last {
            break;
        }
        object += 1;
    }
    if count == 0 {
        return Err(Exception::Address);
    }
    request.set_byte(6, count);
    Ok(request.out)
}

impl<S: Station> Request<'_, S> {
    /// Appends an object: number, length, text. Returns how many there are of it.
    fn put_object(&mut self, object: u8) -> u8 {
        let start = self.out;
        self.put(object);
        self.put(0);
        let text = match object {
            PRODUCT_CODE => Some(self.station.product()),
            _ => TEXTS.get(usize::from(object)).copied(),
        };
        if let Some(text) = text {
            text.bytes().for_each(|byte| self.put(byte));
        } else if object == USER_APPLICATION_NAME {
            let mut index = 0;
            while let Some(byte) =
                self.station.plc().program().and_then(|program| program.plan().name().nth(index))
            {
                self.put(byte);
                index += 1;
            }
        }
        let len = self.out - start - 2;
        if len == 0 {
            self.out = start;
            return 0;
        }
        self.set_byte(start + 1, len);
        1
    }
}
